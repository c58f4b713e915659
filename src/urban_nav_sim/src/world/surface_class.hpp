// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace urban_nav_sim {

/// Classes of the classifier of the paper (Newman et al. 2009, section 8), with the numbers of cloud.ply.
enum class SurfaceClass : std::uint8_t {
  Other = 0,
  Grass = 1,
  Paved = 2,  ///< tarmac, paving
  DirtPath = 3,
  TexturedWall = 4,
  SmoothWall = 5,
  Foliage = 6,
  Vehicle = 7
};

const char* surfaceClassName(SurfaceClass surface_class);

}  // namespace urban_nav_sim
