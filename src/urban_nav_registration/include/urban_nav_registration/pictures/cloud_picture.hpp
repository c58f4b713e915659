// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/point_cloud.hpp"
#include "urban_nav_registration/pictures/picture.hpp"

namespace urban_nav_registration {
/// Size and content of a picture of two aligned clouds.
struct CloudPictureOptions {
  int panel = 400;  ///< px, width and height of each of the three panels
  std::vector<urban_nav_core::Vector6d>
      free_directions;  ///< free directions of the alignment, drawn as lines through the source's origin
  std::string caption;  ///< text below the panels, such as Alignment::sentence; ASCII
};

/// Draws two clouds, the target in red, the source in blue, purple where both have points (Newman et al. 2009, Fig.
/// 15): from above at `T_guess`, from above and from the side (x to the right, z up) at `T_target_source`, all at the
/// same scale with a scale bar. Axes of the target; dots mark the two origins. Ignores points that are not finite;
/// empty panels are labelled. Thread-safe.
Picture drawClouds(const urban_nav_core::PointCloud& source, const urban_nav_core::PointCloud& target,
                   const urban_nav_core::Pose& T_guess, const urban_nav_core::Pose& T_target_source,
                   const CloudPictureOptions& options = {});

}  // namespace urban_nav_registration
