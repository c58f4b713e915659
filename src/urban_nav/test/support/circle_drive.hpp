// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "map/closure_rows.hpp"
#include "map/session_odometry.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace urban_nav::testing {

constexpr urban_nav_core::StampNs kStep = 50'000'000;

/// A circle of 10 m, once in 600 steps.
inline urban_nav_core::Pose truthAt(double step) {
  const double angle = 2.0 * M_PI * step / 600.0;
  return urban_nav_core::Pose(urban_nav_core::expSo3({0.0, 0.0, angle}),
                              Eigen::Vector3d(10.0 * std::sin(angle), 10.0 - 10.0 * std::cos(angle), 0.0));
}

/// Odometry that turns a little too far at each step.
inline SessionOdometry driveCircle(int first, int last, double turn) {
  SessionOdometry run;
  urban_nav_core::Pose odom;
  for (int i = first; i <= last; ++i) {
    SmoothedFrame settled;
    settled.stamp = i * kStep;
    settled.from_previous.from = (i == first ? i : i - 1) * kStep;
    settled.from_previous.to = i * kStep;
    settled.from_previous.covariance = 1e-6 * urban_nav_core::Matrix6d::Identity();
    if (i > first) {
      settled.from_previous.T_from_to =
          truthAt(i - 1).inverse() * truthAt(i) *
          urban_nav_core::Pose(urban_nav_core::expSo3({0.0, 0.0, turn}), Eigen::Vector3d::Zero());
      odom = odom * settled.from_previous.T_from_to;
    }
    settled.T_odom_base.pose = odom;
    settled.T_odom_base.covariance = 1e-5 * (i - first) * urban_nav_core::Matrix6d::Identity();
    run.settled.push_back(settled);
    OdometryFrame row;
    row.stamp = settled.stamp;
    run.frames.push_back(row);
  }
  return run;
}

/// A stereo closure between two moments of the circle, exact, as from a file that states 0.02 m and 0.005 rad.
inline urban_nav_core::MetricClosure closure(const std::string& a, double step_a, const std::string& b, double step_b) {
  urban_nav_core::ClosureRow row;
  row.a = {a, static_cast<urban_nav_core::StampNs>(step_a * static_cast<double>(kStep))};
  row.b = {b, static_cast<urban_nav_core::StampNs>(step_b * static_cast<double>(kStep))};
  row.method = urban_nav_core::ClosureMethod::Stereo;
  row.T_a_b = truthAt(step_a).inverse() * truthAt(step_b);
  row.sigma_m = 0.02;
  row.sigma_rad = 0.005;
  row.where = a + std::to_string(step_a) + b + std::to_string(step_b);
  return toMetricClosure(row);
}

}  // namespace urban_nav::testing
