// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Image of a camera that colours the map: of a panoramic head, or another one (StoredPanoramaCamera).
struct StoredPanorama {
  SessionId session;
  std::int64_t camera = 0;            ///< number of the camera
  urban_nav_core::StampNs stamp = 0;  ///< of the image
  std::string jpeg;
  static Table table() {
    Table table{"panorama", 3};
    table.since = 3;
    table.wide = true;
    table.kept_by_clear = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("camera", camera);
    columns.integer("stamp_ns", stamp);
    columns.blob("jpeg", jpeg);
  }
};

}  // namespace urban_nav_store
