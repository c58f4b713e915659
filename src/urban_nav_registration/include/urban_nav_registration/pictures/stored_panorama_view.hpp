// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/camera/raw_camera.hpp"
#include "urban_nav_registration/pictures/picture.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_panorama.hpp"
#include "urban_nav_store/tables/stored_panorama_camera.hpp"

namespace urban_nav_registration {

/// Returns the camera of a row of the store.
inline urban_nav_core::RawCamera storedRawCamera(const urban_nav_store::StoredPanoramaCamera& row) {
  urban_nav_core::RawCamera camera;
  camera.pinhole = {row.fx, row.fy, row.cx, row.cy, static_cast<int>(row.width), static_cast<int>(row.height)};
  camera.distortion = urban_nav_core::Distortion(row.distortion);
  return camera;
}

/// Key of an image of the panoramic head in the store.
struct PanoramaKey {
  urban_nav_store::SessionId session;
  std::int64_t camera = 0;
  urban_nav_core::StampNs stamp = 0;
};

/// Reads and decodes an image; returns an empty picture if it is not in the store.
inline Picture loadPanorama(urban_nav_store::Store& store, const PanoramaKey& key) {
  using urban_nav_store::StoredPanorama;
  const auto row = urban_nav_store::TableStore<StoredPanorama>(store).get({key.session, key.camera, key.stamp, {}});
  return row ? decodePicture(row->jpeg) : Picture();
}

}  // namespace urban_nav_registration
