// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/point_cloud.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_registration/parameters.hpp"

namespace urban_nav_registration {
/// Reason why an alignment is rejected.
enum class AlignmentReason {
  None,
  TooFewPoints,   ///< too few finite points in one of the clouds
  NoSurfaces,     ///< too few surfaces: all points coincide or are collinear, or the scale is wrong
  TooFewMatches,  ///< almost no overlap
  ResidualTooLarge,
  TooFewInliers,
  NotConverged,    ///< the pose still changed in the last step
  Ambiguous,       ///< a different pose fits equally well
  Impossible,      ///< the surfaces fit, but the caller excludes the pose
  Misfit,          ///< residuals exceed noise and deformation
  SeenThrough,     ///< beams of one cloud passed through surfaces of the other
  FreeDirections,  ///< reason of a degenerate result
};
/// Returns "" for None, else the enumerator in small letters and underscores.
const char* toString(AlignmentReason reason);

/// One test of the classifier (Newman et al. 2009, section 4.2), with its measured value and threshold.
struct AlignmentTest {
  std::string name;
  double value = 0.0, threshold = 0.0;
  bool at_least = false;  ///< value >= threshold is required, else value <= threshold
  bool passed = false;
};

/// Second best pose of a global search, different from the best one.
struct Alternative {
  urban_nav_core::Pose T_target_source;
  double share = 0.0;  ///< its fit relative to the best one; ambiguous above `max_second_best_ratio`
};

/// Result of an alignment.
///
/// WARNING: `information` is singular along free directions and must not be inverted. Tangent (rho, phi), T = [Exp(phi)
/// R, t + rho], both in the target frame.
struct Alignment {
  urban_nav_core::Pose T_target_source;
  urban_nav_core::Matrix6d information = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::Matrix6d covariance =
      urban_nav_core::Matrix6d::Zero();                   ///< for display: 1e6 m^2 and 10 rad^2 along free directions
  std::vector<urban_nav_core::Vector6d> free_directions;  ///< unit vectors; information along them is zero
  urban_nav_core::ClosureVerdict verdict = urban_nav_core::ClosureVerdict::Rejected;
  AlignmentReason reason = AlignmentReason::None;
  std::string sentence;  ///< explanation for the user
  std::vector<AlignmentTest> tests;
  std::size_t source_points = 0, target_points = 0;      ///< points used
  std::size_t source_left_out = 0, target_left_out = 0;  ///< points that are not finite, or too far away
  std::size_t matches = 0;
  int iterations = 0;
  bool searched = false;  ///< the pose comes from the global search
  /// Both clouds are planar scans. Height, roll and pitch are not measured: the information along them is zero, and
  /// they affect neither the verdict nor `free_directions`.
  bool planar = false;
  std::optional<Alternative> alternative;  ///< result of a global search with several possible poses
};
/// When the global search runs.
enum class SearchMode {
  /// From the guess, then by a global search if that is rejected. A result accepted from the guess is compared with
  /// alternatives of a coarse search, unless it is degenerate.
  IfRejected,
  AtOnce,
  Never,
};

/// Returns whether T_target_source is consistent with other information on the pose, mainly odometry. Its information
/// is that of the clouds, zero along free directions, so that a pose that may slide along a wall is not rejected for
/// its position there. Called from the calling thread only.
using PosePredicate = std::function<bool(const urban_nav_core::Constraint& T_target_source)>;

/// Prior information besides the clouds.
struct AlignmentPrior {
  PosePredicate is_possible;
  /// Deformation of the two clouds by the drift of odometry, m. If it is given and both clouds have origins, further
  /// tests apply: residuals must be consistent with noise and deformation, and beams of one cloud must not pass through
  /// surfaces of the other; surfaces observed by one cloud only no longer count against a pose.
  std::optional<double> deformation_sigma;
};

/// Aligns two clouds by their surfaces: point-to-plane ICP from coarse to fine, from `guess`, with a classifier that
/// detects unconstrained directions (Newman et al. 2009, section 4.2). A global search requires sensors that are
/// upright within 35 deg. Poses excluded by `known` are neither results nor alternatives: with a known heading, a
/// street that is similar in both directions is not ambiguous. Accepts any clouds, also empty ones; the result is
/// finite and has a reason if it is rejected. Thread-safe; the same bits for any number of threads.
Alignment align(const urban_nav_core::PointCloud& source, const urban_nav_core::PointCloud& target,
                const Parameters& parameters, const urban_nav_core::Pose& guess = {},
                SearchMode search = SearchMode::IfRejected, const AlignmentPrior& known = {});

}  // namespace urban_nav_registration
