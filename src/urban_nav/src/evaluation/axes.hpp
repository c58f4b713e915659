// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/trajectory/associate.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav {

/// Differences between the axes of the moving frames of two trajectories differ. World frames need no comparison: first
/// poses are aligned.
enum class Axes {
  Same,
  EstimateOptical,  ///< the estimate has those of a camera (z forward, x right), the truth those of a body (x forward)
  TruthOptical,     ///< the reverse
  NedEnu,           ///< one has y right and z down (NED), the other y left and z up (ENU, REP-103)
  Turned            ///< another of the 24 rotations that exchange axes
};

/// The difference found between the axes of two trajectories.
struct AxesMatch {
  Axes axes = Axes::Same;
  urban_nav_core::Matrix3d R_truth_estimate = urban_nav_core::Matrix3d::Identity();  ///< of the moving frames
};

/// Returns the rotation of the 24 that exchange axes with which the poses agree much better (a tenth of the error, and
/// under a fifth of the path); Same for anything less clear.
AxesMatch detectAxes(const urban_nav_core::Matched& matched);

/// Turns the poses of the estimate, or of a truth with optical axes, so that both have the same axes.
void applyAxes(const AxesMatch& match, urban_nav_core::Matched& matched);
/// Returns the covariance of an estimate's pose after that, in the axes of its first pose.
urban_nav_core::Matrix6d applyAxes(const AxesMatch& match, const urban_nav_core::Matrix6d& covariance);

/// Returns what was found and done, for the user; empty for Same.
std::string describe(const AxesMatch& match);
/// Returns the value of `axes` in the summary.
std::string axesKey(const AxesMatch& match);

}  // namespace urban_nav
