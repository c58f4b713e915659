// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "urban_nav_core/image/pyramid.hpp"
#include "urban_nav_registration/pictures/picture.hpp"

namespace laser_mapper {

/// Logarithm of the brightness at a position of an image, and its gradient.
struct ViewBrightness {
  double value = 0.0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< per pixel of level 0
};

/// Returns the interpolated brightness of a level; nullopt within two pixels of its border, and if it is nearly
/// saturated or black. `pixel`: of level 0.
std::optional<ViewBrightness> brightnessAt(const urban_nav_core::Pyramid& pyramid, int level,
                                           const Eigen::Vector2d& pixel);

/// Returns the grey image pyramid of a picture.
urban_nav_core::Pyramid greyPyramid(const urban_nav_registration::Picture& picture, int levels);

}  // namespace laser_mapper
