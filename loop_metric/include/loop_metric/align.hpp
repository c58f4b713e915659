// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "loop_metric/parameters.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/point_cloud.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace loop_metric {

enum class Reason {
  None,
  TooFewPoints,   ///< one of the clouds holds too few that are finite
  NoSurfaces,     ///< too few pieces of surface: all points equal, on a line, or another scale
  TooFewMatches,  ///< the two hardly meet
  ResidualTooLarge,
  TooFewInliers,
  NotConverged,    ///< it still moved at the end
  Ambiguous,       ///< another, different pose fits as well
  Impossible,      ///< the surfaces fit, but the caller knows that the pose cannot be
  Misfit,          ///< the surfaces lie further apart than their noise explains
  SeenThrough,     ///< beams of one cloud went through surfaces of the other
  FreeDirections,  ///< of a degenerate answer
};
/// "" for None, else the enumerator's name in small letters and underscores.
const char* toString(Reason reason);

/// One test of the classifier (Newman et al. 2009, section 4.2): what was measured, and what was asked for.
struct Test {
  std::string name;
  double value = 0.0, threshold = 0.0;
  bool at_least = false;  ///< the value has to be at least the threshold; else at most
  bool passed = false;
};

/// The next best pose that a search found and that is a different one.
struct Rival {
  urban_nav_core::Pose T_target_source;
  double share =
      0.0;  ///< how well it fits, as a share of how well the answer does; above `max_second` the place is ambiguous
};

/// What came of an alignment.
///
/// WARNING: `information` is singular where directions are free, and must not be inverted. Convention of everything that leaves a
/// stage (docs/conventions.md): tangent (rho, phi), T = [Exp(phi) R, t + rho], both in the target frame.
struct Alignment {
  urban_nav_core::Pose T_target_source;
  urban_nav_core::Matrix6d information = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::Matrix6d covariance =
      urban_nav_core::Matrix6d::Zero();                   ///< for display: 1e6 m^2 and 10 rad^2 along what is free
  std::vector<urban_nav_core::Vector6d> free_directions;  ///< unit vectors; information along them is zero
  urban_nav_core::ClosureVerdict verdict = urban_nav_core::ClosureVerdict::Rejected;
  Reason reason = Reason::None;
  std::string sentence;  ///< the reason for a person
  std::vector<Test> tests;
  std::size_t source_points = 0, target_points = 0;      ///< that were used
  std::size_t source_left_out = 0, target_left_out = 0;  ///< NaN, infinite, or absurdly far
  std::size_t matches = 0;
  int iterations = 0;
  bool searched = false;       ///< the pose comes from the global search
  std::optional<Rival> rival;  ///< of a global search that found more than one pose; only among those that are possible
};

enum class Search {
  /// From the guess; a global search where that is rejected. An accepted answer is held against what a glance around finds elsewhere; a
  /// degenerate one stands.
  IfRejected,
  AtOnce,
  Never,
};

/// What the caller knows of the pose from elsewhere, odometry above all: can T_target_source be this? The information is what the clouds say of
/// it, zero along what they leave free, so that a pose which may slide along a wall is not refused for where it happens to lie there.
/// Called from the calling thread alone.
using Possible = std::function<bool(const urban_nav_core::Constraint& T_target_source)>;

/// What the caller knows beside the clouds.
struct Known {
  Possible possible;
  /// By how much the two clouds may be bent, m, as those are that were gathered along a way by odometry. With it, and where both clouds know the origins of their
  /// beams, the classifier asks what it cannot ask of clouds out of files: whether residuals are no larger than noise and bend explain, and whether
  /// one cloud saw through the surfaces of the other; and surfaces that only one of them saw count no more against a pose.
  std::optional<double> bend;
};

/// T_target_source of two clouds from their surfaces: point-to-plane ICP from coarse to fine, from `guess`, with a classifier that knows
/// which directions nothing holds (Newman et al. 2009, section 4.2). The sensors stand roughly upright (z up, within 35 deg) where the search is
/// global. What is not `possible` is neither an answer nor a rival that makes the place ambiguous: a caller who knows the heading to a
/// few degrees gets an answer in a street that looks the same both ways. Any clouds may come, empty ones too: the answer is finite and says what is wrong. No state: thread-safe; the same bits whatever
/// the number of threads.
Alignment align(const urban_nav_core::PointCloud& source, const urban_nav_core::PointCloud& target,
                const Parameters& parameters, const urban_nav_core::Pose& guess = {},
                Search search = Search::IfRejected, const Known& known = {});

}  // namespace loop_metric
