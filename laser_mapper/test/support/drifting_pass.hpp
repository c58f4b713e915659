// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "laser_mapper/quality/odometry_drift.hpp"
#include "laser_mapper/quality/plane_place.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper::testing_drift {

using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector6d;

constexpr StampNs kDriftStep = 20'000'000;
constexpr double kPatchHalf = 0.6;  // m

/// A random walk of 5 mm and 0.3 mrad per root of a second.
inline Matrix6d walkRate() {
  Vector6d rate;
  rate << Vector3d::Constant(25e-6), Vector3d::Constant(9e-8);
  return rate.asDiagonal();
}

/// A robot that drives along x for 4 s at 1 m/s, with an odometry whose error is a random walk.
struct DriftingPass {
  Trajectory truth, mapped;
  OdometryDrift drift;

  DriftingPass(StampNs begin, const Matrix6d& rate, std::mt19937& random) {
    std::normal_distribution<double> normal(0.0, 1.0);
    const Matrix6d covariance = 1e-9 * static_cast<double>(kDriftStep) * rate;
    const Vector6d sigmas = covariance.diagonal().cwiseSqrt();
    for (int i = 0; i <= 200; ++i) {
      const StampNs stamp = begin + i * kDriftStep;
      truth.append(stamp, Pose(Eigen::Quaterniond::Identity(), Vector3d(0.02 * i, 0.0, 0.0)));
      if (i == 0) {
        mapped.append(stamp, truth[0].pose);
        continue;
      }
      const auto at = static_cast<std::size_t>(i);
      const Vector6d error = sigmas.cwiseProduct(Vector6d::NullaryExpr([&](Eigen::Index) { return normal(random); }));
      urban_nav_core::RelativePose step;
      step.from = truth[at - 1].stamp;
      step.to = stamp;
      step.T_from_to = urban_nav_core::boxPlus(truth[at - 1].pose.inverse() * truth[at].pose, error);
      step.covariance = covariance;
      mapped.append(stamp, mapped[at - 1].pose * step.T_from_to);
      drift.add(step);
    }
  }

  /// Returns the measurement of a flat patch of 1.2 m around `p`, scanned column by column while driving by.
  PlanePatch see(const Vector3d& p, const Vector3d& normal) const {
    const Vector3d across = normal.cross(Vector3d::UnitX());
    std::vector<Vector3d> points;
    std::vector<double> seconds;
    for (double x = -kPatchHalf; x < kPatchHalf + 1e-9; x += 0.1)
      for (double y = -kPatchHalf; y < kPatchHalf + 1e-9; y += 0.3) {
        const auto at = static_cast<std::size_t>(std::lround((p.x() + x) / 0.02));
        points.push_back(mapped[at].pose * (truth[at].pose.inverse() * (p + x * Vector3d::UnitX() + y * across)));
        seconds.push_back(p.x() + x);
      }
    const double share = 1.0 / static_cast<double>(points.size());
    PlanePatch patch;
    double variance = 0.0;
    for (const Vector3d& point : points) patch.centre += share * point;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3d d = points[i] - patch.centre;
      patch.scatter += share * d * d.transpose();
      patch.sweep += share * (seconds[i] - p.x()) * d;
      variance += share * (seconds[i] - p.x()) * (seconds[i] - p.x());
    }
    patch.normal = urban_nav_core::smallEigen<3>(patch.scatter).vectors.col(0);
    if (patch.normal.dot(normal) < 0.0) patch.normal = -patch.normal;
    patch.stamp = truth.front().stamp + std::llround(1e9 * p.x());
    patch.stamp_spread = std::sqrt(variance);
    patch.displacement_sigma = 0.0002;
    patch.angle_sigma = 0.0005;
    return patch;
  }
};

}  // namespace laser_mapper::testing_drift
