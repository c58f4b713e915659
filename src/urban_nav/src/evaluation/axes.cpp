// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/axes.hpp"

#include <Eigen/LU>
#include <array>
#include <vector>

#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/trajectory/errors.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav {

using urban_nav_core::Matched;
using urban_nav_core::Matrix3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

namespace {

constexpr double kExact = 1e-9;

Matrix3d opticalInBody() { return urban_nav_ros::opticalInBody().q().toRotationMatrix(); }

bool isSame(const Matrix3d& a, const Matrix3d& b) { return (a - b).cwiseAbs().maxCoeff() < kExact; }

/// Returns the 24 proper rotations with matrix elements 0, 1 and -1.
std::vector<Matrix3d> axisRotations() {
  std::vector<Matrix3d> rotations;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      if (x % 3 == y % 3) continue;
      Matrix3d R;
      R.col(0) = (x < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(x % 3);
      R.col(1) = (y < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(y % 3);
      R.col(2) = R.col(0).cross(R.col(1));
      rotations.push_back(R);
    }
  }
  return rotations;
}

AxesMatch toMatch(const Matrix3d& R) {
  const Matrix3d ned = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  if (isSame(R, Matrix3d::Identity())) return {Axes::Same, R};
  if (isSame(R, opticalInBody())) return {Axes::EstimateOptical, R};
  if (isSame(R, opticalInBody().transpose())) return {Axes::TruthOptical, R};
  return {isSame(R, ned) ? Axes::NedEnu : Axes::Turned, R};
}

double errorWith(const AxesMatch& match, Matched matched) {
  applyAxes(match, matched);
  return urban_nav_core::absoluteError(matched.truth, matched.estimate, urban_nav_core::TrajectoryAlignment::First)
      .rmse;
}

/// "x = -y, y = x, z = z": the axes of the estimate by those of the truth.
std::string axesText(const Matrix3d& R) {
  std::vector<std::string> parts;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Index of_truth = 0;
    R.col(axis).cwiseAbs().maxCoeff(&of_truth);
    parts.push_back(std::string(1, "xyz"[axis]) + " = " + (R(of_truth, axis) < 0.0 ? "-" : "") + "xyz"[of_truth]);
  }
  return urban_nav_core::joined(parts);
}

}  // namespace

AxesMatch detectAxes(const Matched& matched) {
  constexpr double kBetter = 0.1, kOfPath = 0.2;
  if (matched.truth.size() < 2) return {};
  const double length = urban_nav_core::pathLength(matched.truth), same = errorWith({}, matched);
  if (same <= kOfPath * kBetter * length) return {};
  AxesMatch best;
  double least = same;
  for (const Matrix3d& R : axisRotations()) {
    const AxesMatch match = toMatch(R);
    const double error = errorWith(match, matched);
    // A rotation about a straight path is not observable: known conventions take precedence.
    const bool is_tied = error < least + kExact * length && best.axes == Axes::Turned && match.axes != Axes::Turned;
    if (error < least - kExact * length || is_tied) {
      best = match;
      least = error;
    }
  }
  return least < kBetter * same && least < kOfPath * length ? best : AxesMatch{};
}

void applyAxes(const AxesMatch& match, Matched& matched) {
  if (match.axes == Axes::Same) return;
  const bool of_truth = match.axes == Axes::TruthOptical;
  const Matrix3d R = of_truth ? Matrix3d(match.R_truth_estimate.transpose()) : match.R_truth_estimate;
  const Pose turn(R, Eigen::Vector3d::Zero());
  for (Pose& pose : of_truth ? matched.truth : matched.estimate) pose = turn * pose * turn.inverse();
}

Matrix6d applyAxes(const AxesMatch& match, const Matrix6d& covariance) {
  if (match.axes == Axes::Same || match.axes == Axes::TruthOptical) return covariance;
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = match.R_truth_estimate;
  return turn * covariance * turn.transpose();
}

std::string describe(const AxesMatch& match) {
  switch (match.axes) {
    case Axes::EstimateOptical:
      return "the estimate has the axes of a camera (z forward), the truth those of a body (x forward): the estimate "
             "is rotated";
    case Axes::TruthOptical:
      return "the truth has the axes of a camera (z forward), the estimate those of a body (x forward): the truth is "
             "rotated";
    case Axes::NedEnu:
      return "one file is in NED (body: x forward, y right, z down), the other in ENU (x forward, y left, z up): the "
             "estimate is rotated by 180 deg about x";
    case Axes::Turned:
      return "the axes of the two files differ (the estimate's by the truth's: " + axesText(match.R_truth_estimate) +
             "): the estimate is rotated";
    case Axes::Same: break;
  }
  return "";
}

std::string axesKey(const AxesMatch& match) {
  switch (match.axes) {
    case Axes::EstimateOptical: return "estimate_optical";
    case Axes::TruthOptical: return "truth_optical";
    case Axes::NedEnu: return "ned_enu";
    case Axes::Turned: return axesText(match.R_truth_estimate);
    case Axes::Same: break;
  }
  return "same";
}

}  // namespace urban_nav
