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

/// The light that reaches each pixel, before lens and sensor spoil it. Row by row.
struct Picture {
  int width = 0, height = 0;
  int channels = 1;                         ///< 1 grey, 3 red, green, blue
  std::vector<float> radiance;              ///< linear, `channels` for each pixel; 1 = a white sheet in the sun
  std::vector<float> depth;                 ///< m along the optical axis; infinite for the sky
  std::vector<std::uint8_t> surface_class;  ///< SurfaceClass; Other for the sky

  std::size_t at(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
};

/// What a camera sees from `T_world_camera` at the time of the snapshot: a ray through the middle of each pixel, whose
/// looks are filtered over it, and several where an edge goes through (edges.hpp). Depth and class are those of the
/// middle. `picture` is made to fit; given again, it is not allocated again. The same bytes whatever the number of
/// threads.
void render(const Snapshot& snapshot, const Sky& sky, const RayTable& rays, const urban_nav_core::Pose& T_world_camera,
            Colours colours, Picture& picture);

}  // namespace urban_nav_sim
