// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace urban_nav_registration {

/// Point of a keyframe: a corner at a whole pixel of one pyramid level of the left image, with its disparity.
struct KeyframePoint {
  std::int16_t u = 0, v = 0;             ///< px of its level
  std::uint8_t level = 0;                ///< level of urban_nav_core::Pyramid
  float disparity = 0.0F;                ///< px of level 0
  float sigma_disparity = 1.0F;          ///< px of level 0
  float slope_u = 0.0F, slope_v = 0.0F;  ///< d(disparity)/d(u, v): slant of the surface

  /// Returns the pixel in the left image, px of level 0.
  Eigen::Vector2d pixel() const { return {u << level, v << level}; }
};
void archive(urban_nav_core::Archive& archive, KeyframePoint& point);

/// Stereo pair reduced to what a later registration needs (Newman et al. 2009, section 4.1): about 70 kB at 512x384,
/// most of it the image. Plain data.
struct Keyframe {
  urban_nav_core::PoseRef at;
  std::vector<std::uint8_t> image;  ///< left image as greyscale JPEG; empty if it is missing
  int width = 0, height = 0;        ///< px
  std::vector<KeyframePoint> points;
};
/// Serialises a keyframe. Throws DataError when reading other data; the image is decoded later, when it is used.
void archive(urban_nav_core::Archive& archive, Keyframe& keyframe);

}  // namespace urban_nav_registration
