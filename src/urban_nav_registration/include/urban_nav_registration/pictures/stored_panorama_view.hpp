// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

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
  const std::array<double, 8>& k = row.distortion;
  camera.distortion = row.is_equidistant ? urban_nav_core::Distortion::equidistant({k[0], k[1], k[2], k[3]})
                                         : urban_nav_core::Distortion(k);
  return camera;
}

/// Sets size, pinhole and distortion of a row of the store.
inline void setRawCamera(const urban_nav_core::RawCamera& camera, urban_nav_store::StoredPanoramaCamera& row) {
  row.width = camera.pinhole.width;
  row.height = camera.pinhole.height;
  row.fx = camera.pinhole.fx;
  row.fy = camera.pinhole.fy;
  row.cx = camera.pinhole.cx;
  row.cy = camera.pinhole.cy;
  row.distortion = camera.distortion.coefficients();
  row.is_equidistant = camera.distortion.isEquidistant();
}

/// Key of an image of a camera in the store.
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
