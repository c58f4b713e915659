// SPDX-License-Identifier: BSD-3-Clause
#include "quality/stretch_walk.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"

namespace laser_mapper {

using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::StampNs;

namespace {

constexpr double kWalkStep = 0.25;      // s: four steps for a patch of 1.2 m at walking speed
constexpr double kShortestView = 1e-3;  // s
constexpr double kLeastSpread = 1e-12;  // m^4, determinant of the scatter of a patch that extends in two directions

/// Returns a matrix M with M M^T = covariance, which may be singular.
Matrix6d factorCovariance(const Matrix6d& covariance) {
  const auto eigen = urban_nav_core::smallEigen<6>(covariance);
  return eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

/// Returns the share of the times from `first` to `last` after `s` if `s` is after the reference; otherwise minus the
/// share before it.
double shareBeyond(double s, double first, double last) {
  if (s >= 0.0) return std::clamp((last - s) / (last - first), 0.0, 1.0);
  return -std::clamp((s - first) / (last - first), 0.0, 1.0);
}

/// Returns the slope in time, 1/s, of the line fitted to a unit step at a time uniformly distributed between `begin`
/// and `end`; the line is fitted over the times from `first` to `last`. For a step at z (T) from their middle it is 6
/// (1/4 - z^2) / T.
double slopeOfStep(double begin, double end, double first, double last) {
  const auto integral = [&](double s) {
    const double z = std::clamp((s - first) / (last - first), 0.0, 1.0) - 0.5;
    return z / 4.0 - z * z * z / 3.0;
  };
  return 6.0 * (integral(end) - integral(begin)) / (end - begin);
}

/// Returns the factor from a slope in time, m/s, to one along the plane: the gradient of the cells' times, s/m, along
/// the two axes.
Eigen::Vector2d timeGradient(const PlanePatch& patch, const PlaneAxes& axes) {
  Eigen::Matrix<double, 3, 2> along;
  along << axes.first, axes.second;
  const Eigen::Matrix2d scatter = along.transpose() * patch.scatter * along;
  if (!(scatter.determinant() > kLeastSpread)) return Eigen::Vector2d::Zero();
  return scatter.inverse() * (along.transpose() * patch.sweep);
}

}  // namespace

StretchWalk::StretchWalk(const urban_nav_core::Trajectory& T_map_base, StampNs reference, StampNs begin, StampNs end,
                         const OdometryDrift* drift)
    : reference_(reference) {
  if (drift == nullptr) return;
  const Matrix6d rate = drift->rateDuring(begin, end);
  if (rate.isZero(0.0)) return;
  const Matrix6d root = factorCovariance(kWalkStep * rate);
  const int first = static_cast<int>(std::floor(urban_nav_core::secondsBetween(reference, begin) / kWalkStep));
  const int after = static_cast<int>(std::ceil(urban_nav_core::secondsBetween(reference, end) / kWalkStep));
  for (int i = first; i < after; ++i) {
    const double seconds = kWalkStep * i;
    const std::size_t nearest = T_map_base.nearest(reference + std::llround(1e9 * (seconds + 0.5 * kWalkStep)));
    const urban_nav_core::Pose& pose = T_map_base[nearest].pose;
    const Eigen::Matrix3d R = pose.R();
    Step step{seconds, pose.t(), Matrix6d()};
    step.root.topRows<3>() = R * root.topRows<3>();
    step.root.bottomRows<3>() = R * root.bottomRows<3>();
    steps_.push_back(step);
  }
}

Eigen::MatrixXd StretchWalk::rows(const PlanePatch& patch, const PlaneAxes& axes) const {
  Eigen::MatrixXd made(3, size());
  const double middle = urban_nav_core::secondsBetween(reference_, patch.stamp);
  const double half = std::max(std::sqrt(3.0) * patch.stamp_spread, kShortestView);
  // A gradient g of the displacement along the plane is the rotation g x normal.
  const Eigen::Vector2d gradient = timeGradient(patch, axes);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const double share = shareBeyond(step.begin + 0.5 * kWalkStep, middle - half, middle + half);
    const double slope = slopeOfStep(step.begin, step.begin + kWalkStep, middle - half, middle + half);
    Eigen::Matrix<double, 1, 6> displacement;
    displacement << axes.normal.transpose(), (patch.centre - step.t).cross(axes.normal).transpose();
    Eigen::Matrix<double, 3, 6> moved;
    moved << share * displacement, slope * gradient.y() * displacement, -slope * gradient.x() * displacement;
    moved.block<1, 3>(1, 3) += share * axes.first.transpose();
    moved.block<1, 3>(2, 3) += share * axes.second.transpose();
    made.middleCols<6>(6 * static_cast<Eigen::Index>(i)) = moved * step.root;
  }
  return made;
}

}  // namespace laser_mapper
