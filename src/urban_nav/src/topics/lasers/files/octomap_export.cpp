// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/files/octomap_export.hpp"

#include "laser_mapper/layers/octomap_file.hpp"
#include "laser_mapper/layers/space_grid.hpp"
#include "urban_nav_core/io/atomic_file.hpp"

namespace urban_nav {

namespace {

constexpr double kOctomapEdge = 0.1;  // m, the cells of --grid

}  // namespace

void writeOctomap(const std::string& path, const laser_mapper::LaserMap& map, const MappedSessions& mapped) {
  laser_mapper::SpaceGrid space(kOctomapEdge);
  map.forEachTile([&](const laser_mapper::Tile&, const std::vector<laser_mapper::MapPoint>& points) {
    space.add(points, [&](const laser_mapper::MapPoint& point) { return beamOrigin(mapped, point); });
  });
  urban_nav_core::writeAtomically(path, printOctomap(space).bytes);
}

}  // namespace urban_nav
