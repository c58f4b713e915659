// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Sweep of a 3D LiDAR, from which a map can be rebuilt without the recording.
struct LidarSweep {
  SessionId session;
  std::string role;                       ///< role of its sensor: "points0"
  urban_nav_core::StampNs reference = 0;  ///< time to which poses of the sweep refer
  std::string packed;                     ///< result of pack()

  /// Encodes the beams of a sweep, compressed, ring by ring: directions to 0.1 mrad in azimuth and 0.05 mrad in
  /// elevation, ranges to 2 mm, intensities to 1, times to 20 us. Beams beyond 131 m, with times more than 0.65 s from
  /// the reference or with numbers that are not finite are omitted.
  static std::string pack(const urban_nav_core::Sweep& sweep);
  /// Returns a scan for each ring, lowest first: its beams in the order of the sweep, with their ring and without
  /// columns. Throws DataError if the bytes are not those of pack().
  std::vector<urban_nav_core::Scan> rings() const;

  static Table table() {
    Table table{"lidar_sweep", 3};
    table.since = 8;
    table.kept_by_clear = true;
    table.wide = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("role", role);
    columns.integer("reference_ns", reference);
    columns.blob("beams", packed);
  }
};

}  // namespace urban_nav_store
