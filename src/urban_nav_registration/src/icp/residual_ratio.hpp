// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "icp/refine.hpp"
#include "urban_nav_registration/cloud/surfels.hpp"

namespace urban_nav_registration {

/// Robust standard deviations of residuals, m.
struct RobustScale {
  double all = 0.0;
  double upright = 0.0;  ///< vertical surfaces only: on flat ground these distinguish places
};
RobustScale computeResidualScale(const std::vector<Match>& matches);

/// Returns the residuals of a cloud relative to itself: surfaces of every other point against those of the remaining
/// points. Includes noise, roughness and voxel effects at edges, as do the residuals between two clouds; 0 for a cloud
/// with too few points.
RobustScale cloudNoise(const urban_nav_core::PointCloud& cloud, float voxel);

}  // namespace urban_nav_registration
