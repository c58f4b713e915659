// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_trust/test_results.hpp"

namespace urban_nav_trust {

constexpr const char* kStereoClosureTest = "odometry_stereo_closures";
constexpr const char* kLaserClosureTest = "odometry_laser_closures";

/// A closure and what odometry alone, which knows of no closure, states of the motion between its two poses.
struct ClosureDifference {
  Interval interval;  ///< from the earlier pose to the later one
  bool by_laser = false;
  /// Closure less odometry along the directions that the closure measured, m or rad, with the covariances of both.
  Eigen::VectorXd difference;
  Eigen::MatrixXd odometry, closure;
  double distance_m = 0.0, angle_rad = 0.0;  ///< between both, whole
};

/// Tests odometry against the closures of each kind: the largest squared Mahalanobis distance, where odometry's
/// covariance is too small by an unknown factor, over all closures (Bonferroni). The closure of median distance is
/// evidence of that factor, once: closures of one place share scans, surfaces and the path between. Adds to `results`
/// tests, absent ones and the evidence. Stereo closures confirm turns; lengths they measure with the same cameras.
/// Derivation: docs/derivations/trust.md.
void testClosures(const std::vector<ClosureDifference>& closures, TestResults& results);

}  // namespace urban_nav_trust
