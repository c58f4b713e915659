// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Points of the maps of a store, evenly thinned to kMostShownPoints, each with the pose from which it was measured:
/// points follow their poses after a relaxation, without rendering.
class MapPoints {
 public:
  using Maps = std::vector<std::vector<urban_nav_store::StoredTrajectory>>;

  /// Reads the points as for `export`, which renders a map whose poses were moved by edits. `memory_mb`: for decoded
  /// images. Throws the errors of the store.
  MapPoints(urban_nav_store::Store& store, const Maps& maps, double memory_mb);

  /// Returns the points at the poses of these maps of the same store. 24 bytes per point, little endian: x, y, z (m, in
  /// its map), seconds since the beginning of its session (float32), index of the session in the order of `maps`
  /// (uint16), sensor, sigma (0.5 mm; 255: at least that), red, green, blue, reflectance (uint8).
  std::string place(const Maps& maps) const;

 private:
  struct Point {
    std::size_t session = 0;
    urban_nav_core::StampNs stamp = 0;
    Eigen::Vector3d p_base = Eigen::Vector3d::Zero();
    laser_mapper::MapPoint shown;
  };
  std::vector<Point> points_;
};

}  // namespace urban_nav
