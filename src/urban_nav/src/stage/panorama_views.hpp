// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/camera/raw_camera.hpp"
#include "urban_nav_store/tables/stored_panorama_camera.hpp"

namespace urban_nav {

/// Returns the camera of a row of the store.
inline urban_nav_core::RawCamera rawCamera(const urban_nav_store::StoredPanoramaCamera& row) {
  urban_nav_core::RawCamera camera;
  camera.pinhole = {row.fx, row.fy, row.cx, row.cy, static_cast<int>(row.width), static_cast<int>(row.height)};
  camera.distortion = urban_nav_core::Distortion(row.distortion);
  return camera;
}

}  // namespace urban_nav
