// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/trajectory/associate.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav {

/// Difference between the axes of the moving frames of two trajectories. World frames are not compared, since first
/// poses are aligned.
enum class Axes {
  Same,
  EstimateOptical,  ///< the estimate has camera axes (z forward, x right), the truth body axes (x forward)
  TruthOptical,     ///< the reverse
  NedEnu,           ///< one has y right and z down (NED), the other y left and z up (ENU, REP-103)
  Turned            ///< another of the 24 rotations that exchange axes
};

/// The difference found between the axes of two trajectories.
struct AxesMatch {
  Axes axes = Axes::Same;
  urban_nav_core::Matrix3d R_truth_estimate = urban_nav_core::Matrix3d::Identity();  ///< of the moving frames
};

/// Returns the one of the 24 axis permutations that reduces the error to a tenth and below a fifth of the path; Same if
/// there is none.
AxesMatch detectAxes(const urban_nav_core::Matched& matched);

/// Rotates the poses of the estimate, or of a truth with optical axes, so that both have the same axes.
void applyAxes(const AxesMatch& match, urban_nav_core::Matched& matched);
/// Returns the covariance of an estimated pose after applyAxes(), in the axes of its first pose.
urban_nav_core::Matrix6d applyAxes(const AxesMatch& match, const urban_nav_core::Matrix6d& covariance);

/// Returns a sentence on the difference and its correction, for the user; empty for Same.
std::string describe(const AxesMatch& match);
/// Returns the value of `axes` in the summary.
std::string axesKey(const AxesMatch& match);

}  // namespace urban_nav
