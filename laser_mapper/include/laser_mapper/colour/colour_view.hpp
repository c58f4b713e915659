// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "urban_nav_core/camera/raw_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_registration/pictures/picture.hpp"

namespace laser_mapper {

/// Image for colouring points.
struct ColourView {
  urban_nav_core::RawCamera camera;
  urban_nav_core::Pose T_map_camera;  ///< of the optical frame, at the time of the image
  urban_nav_core::StampNs stamp = 0;
  std::size_t image = 0;  ///< number passed to ImageLoader
};

/// Returns an image by its number; an empty picture if it cannot be read. Called from one thread.
using ImageLoader = std::function<urban_nav_registration::Picture(std::size_t image)>;

}  // namespace laser_mapper
