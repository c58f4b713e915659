// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "camera/ray_table.hpp"
#include "camera/sky.hpp"
#include "ray_tracing/tracer.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim {

enum class Colours { Grey, Rgb };

/// Radiance of each pixel, without effects of lens and sensor. Row by row.
struct Picture {
  int width = 0, height = 0;
  int channels = 1;                         ///< 1 grey, 3 red, green, blue
  std::vector<float> radiance;              ///< linear, `channels` per pixel; 1 = a white sheet in the sun
  std::vector<float> depth;                 ///< m along the optical axis; infinite for the sky
  std::vector<std::uint8_t> surface_class;  ///< SurfaceClass; Other for the sky

  std::size_t at(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
};

/// Renders the view from `T_world_camera` at the time of the snapshot: one ray through the centre of each pixel, with
/// appearance filtered over the pixel, and several rays at edges (edges.hpp). Depth and class are those of the centre.
/// `picture` is resized, and its memory reused. The result does not depend on the number of threads.
void render(const Snapshot& snapshot, const Sky& sky, const RayTable& rays, const urban_nav_core::Pose& T_world_camera,
            Colours colours, Picture& picture);

}  // namespace urban_nav_sim
