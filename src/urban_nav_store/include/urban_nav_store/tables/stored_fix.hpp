// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Position measured by a GPS receiver, in WGS 84.
struct StoredFix {
  SessionId session;
  urban_nav_core::StampNs stamp = 0;
  double latitude = 0.0, longitude = 0.0;                      ///< deg
  double height = 0.0;                                         ///< m above the ellipsoid
  double sigma_east = 0.0, sigma_north = 0.0, sigma_up = 0.0;  ///< m, as stated by the receiver
  double x = 0.0, y = 0.0, z = 0.0;                            ///< m, antenna in base_link
  static Table table() {
    Table table{"fix", 2};
    table.since = 4;
    table.kept_by_clear = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("stamp_ns", stamp);
    columns.real("latitude_deg", latitude);
    columns.real("longitude_deg", longitude);
    columns.real("height_m", height);
    columns.real("sigma_east_m", sigma_east);
    columns.real("sigma_north_m", sigma_north);
    columns.real("sigma_up_m", sigma_up);
    columns.real("x", x);
    columns.real("y", y);
    columns.real("z", z);
  }
};

}  // namespace urban_nav_store
