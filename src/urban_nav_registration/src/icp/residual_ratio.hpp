// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "icp/refine.hpp"
#include "urban_nav_registration/cloud/surfels.hpp"

namespace urban_nav_registration {

/// Robust deviations of residuals, m.
struct RobustScale {
  double all = 0.0;
  double upright = 0.0;  ///< of surfaces that stand up in the target's frame alone: on flat ground they are the ones
                         ///< that tell places apart
};
RobustScale computeResidualScale(const std::vector<Match>& matches);

/// How well a cloud agrees with itself: the surfaces of every other point beside those of the points between. Noise,
/// roughness and what the cubes make of edges are in it, as they are in the residuals between two clouds; 0 for a cloud
/// of too few points.
RobustScale cloudNoise(const urban_nav_core::PointCloud& cloud, float voxel);

}  // namespace urban_nav_registration
