// SPDX-License-Identifier: BSD-3-Clause
#include "window/pose_only_optimisation.hpp"

#include <cmath>

#include "urban_nav_core/geometry/dense.hpp"
#include "window/measurements.hpp"

namespace swf_vo {

using Eigen::Vector3d;
using urban_nav_core::boxMinus;
using urban_nav_core::boxPlus;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

namespace {

constexpr int kMostNewestSteps = 6;
constexpr int kFewestForPose = 3;
// d^T g of the last step, chi-square.
constexpr double kNearEnough = 1e-2;

bool isNew(const LandmarkBlock& landmark) { return landmark.seen.size() == 1 && landmark.prior < 0 && !landmark.known; }

// Accumulates A and b of the pose over landmarks with measurements in other poses too; returns their number.
int addLandmarks(const State& state, const SensorModel& sensor, double huber, Matrix6d& A, Vector6d& b) {
  const PoseMatrices pose(state.poses.back().estimate);
  const std::int64_t step = state.newestStep();
  SensorModel::Linearised at;
  Vector3d z;
  int known = 0;
  for (const LandmarkBlock& landmark : state.landmarks) {
    if (!landmark.used || landmark.seen.empty() || landmark.seen.back().step != step || isNew(landmark)) continue;
    const Measurement& measurement = landmark.seen.back();
    if (!sensor.predict(landmark.anchor, landmark.estimate, pose, z)) continue;
    if (!sensor.linearise(landmark.anchor, landmark.estimate, pose, at)) continue;
    const Vector3d r = measurements::withoutOffset(state, measurement.z) - z;
    const double s = std::sqrt(r.dot(measurement.information * r));
    const double weight = huber > 0.0 && s > huber ? huber / s : 1.0;
    const Eigen::Matrix<double, 3, 6> J = at.pose();
    const Eigen::Matrix<double, 6, 3> JW = weight * (J.transpose() * measurement.information);
    A.noalias() += JW * J;
    b.noalias() += JW * r;
    ++known;
  }
  return known;
}

}  // namespace

void optimiseNewestPose(State& state, const SensorModel& sensor, double huber) {
  PoseBlock& newest = state.poses.back();
  const Pose predicted = newest.estimate;
  // Information of the prediction, in the axes of odom.
  Matrix6d lift = Matrix6d::Zero();
  lift.topLeftCorner<3, 3>() = lift.bottomRightCorner<3, 3>() = predicted.R();
  const Matrix6d held = lift * (process_model::floor() + newest.u.information) * lift.transpose();
  int known = 0;
  for (int i = 0; i < kMostNewestSteps; ++i) {
    Matrix6d A = held;
    Vector6d b = -held * boxMinus(newest.estimate, predicted);
    known = addLandmarks(state, sensor, huber, A, b);
    if (known < kFewestForPose) break;
    Vector6d d = b;
    if (!urban_nav_core::solvePositiveDefiniteInPlace(A, d) || !d.allFinite()) break;
    newest.estimate = boxPlus(newest.estimate, d);
    if (d.dot(b) < kNearEnough) break;
  }
  if (known < kFewestForPose || !newest.estimate.isFinite()) newest.estimate = predicted;
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot) {
    const LandmarkBlock& landmark = state.landmarks[slot];
    if (!landmark.used || landmark.seen.empty() || landmark.seen.back().step != state.newestStep() || !isNew(landmark))
      continue;
    measurements::place(state, sensor, static_cast<int>(slot), landmark.seen.back());
  }
}

}  // namespace swf_vo
