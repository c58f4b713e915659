// SPDX-License-Identifier: BSD-3-Clause
#include "world/surface_class.hpp"

namespace urban_nav_sim {

const char* surfaceClassName(SurfaceClass surface_class) {
  switch (surface_class) {
    case SurfaceClass::Grass: return "grass";
    case SurfaceClass::Paved: return "tarmac/paved";
    case SurfaceClass::DirtPath: return "dirt path";
    case SurfaceClass::TexturedWall: return "textured wall";
    case SurfaceClass::SmoothWall: return "smooth wall";
    case SurfaceClass::Foliage: return "bush/foliage";
    case SurfaceClass::Vehicle: return "vehicle";
    default: return "other";
  }
}

}  // namespace urban_nav_sim
