// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "laser_mapper/map_cell.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_store/tables/depth_image.hpp"
#include "urban_nav_store/tables/depth_view.hpp"

namespace laser_mapper {

/// Subsampled depth image of a stereo pair or a depth camera.
struct DepthFrame {
  urban_nav_core::StampNs stamp = 0;
  std::uint8_t sensor = kStereo;                     ///< as MapCell::laser
  float floor = 0.15F;                               ///< px: errors common to adjacent pixels, not in their deviations
  urban_nav_core::Pose T_base_camera;                ///< optical frame, of stereo that of the left camera
  float step = 1.0F;                                 ///< px of the full image, between samples
  float fx = 0.0F, fy = 0.0F, cx = 0.0F, cy = 0.0F;  ///< px, of the full image
  float focal_baseline = 0.0F;                       ///< px m: disparity times depth
  urban_nav_store::DepthView::Samples samples;

  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(samples.width) + static_cast<std::size_t>(u);
  }
};

/// Returns a stored view. Throws DataError if it is damaged.
DepthFrame depthFrame(const urban_nav_store::DepthView& view);
/// Returns a stored image of a depth camera. `sigma`: standard deviation at 1 m, m; it grows with the squared depth.
/// Throws DataError if it is damaged.
DepthFrame depthFrame(const urban_nav_store::DepthImage& image, std::uint8_t sensor, double sigma);

}  // namespace laser_mapper
