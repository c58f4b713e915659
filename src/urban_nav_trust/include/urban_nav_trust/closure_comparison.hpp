// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_trust/test_results.hpp"

namespace urban_nav_trust {

constexpr const char* kStereoClosureTest = "odometry_stereo_closures";
constexpr const char* kLaserClosureTest = "odometry_laser_closures";
constexpr const char* kPassTest = "plane_passes";

/// A closure, or a constraint from planes of two passes, compared with the motion between its two poses by odometry
/// only, without other closures.
struct ClosureDifference {
  Interval interval;  ///< from the earlier pose to the later one
  bool by_laser = false;
  /// Closure minus odometry along the directions measured by the closure, m or rad, with the covariances of both.
  Eigen::VectorXd difference;
  Eigen::MatrixXd odometry, closure;
  double distance_m = 0.0, angle_rad = 0.0;  ///< magnitude of the difference
};

/// Tests odometry against the closures of each kind: the largest squared Mahalanobis distance over all closures
/// (Bonferroni), given that odometry's covariance is too small by an unknown factor. The closure of median distance is
/// used once as evidence on that factor, because closures of one place share scans, surfaces and the path between. Adds
/// tests, absent tests and the evidence to `results`. Stereo closures confirm turns only, since they measure lengths
/// with the same cameras. Derivation: docs/derivations/trust.md.
void testClosures(const std::vector<ClosureDifference>& closures, TestResults& results);

/// Tests planes measured in one pass of the lasers against the same planes in another one, each pass placed by
/// odometry: `planes` are their constraints, whatever the pose graph decided on them. The p-value is at most twice the
/// median of the p-values of all constraints, valid for any dependence between them (Rueger 1978): some planes may be
/// confused, but not half of them. Odometry's covariance is too small by an unknown factor. Adds a test or an absent
/// one. `absent_reason`: without planes.
void testPlanes(const std::vector<ClosureDifference>& planes, const char* absent_reason, TestResults& results);

}  // namespace urban_nav_trust
