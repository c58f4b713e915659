// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "loop_metric/picture.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/point_cloud.hpp"

namespace loop_metric {

struct CloudPictureOptions {
  int panel = 400;  ///< px, width and height of each of the three
  std::vector<urban_nav_core::Vector6d>
      free_directions;  ///< of the alignment: shown as lines through the source's origin
  std::string caption;  ///< below, such as Alignment::sentence; ASCII
};

/// Two clouds, the target in red, the source in blue, purple where both have points (Newman et al. 2009, Fig. 15): from above as `T_guess` lays
/// them, from above and from the side (x to the right, z up) as `T_target_source` does, all at one scale with a bar of it. Axes are the target's; dots mark where the
/// two origins lie. Points that are not finite are left out; without any the panels say so. Thread-safe.
Picture drawClouds(const urban_nav_core::PointCloud& source, const urban_nav_core::PointCloud& target,
                   const urban_nav_core::Pose& T_guess, const urban_nav_core::Pose& T_target_source,
                   const CloudPictureOptions& options = {});

}  // namespace loop_metric
