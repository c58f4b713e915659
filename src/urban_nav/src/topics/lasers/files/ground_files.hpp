// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/layers/ground_grid.hpp"
#include "topics/lasers/files/map_axes.hpp"
#include "topics/lasers/files/mapped_sessions.hpp"
#include "topics/lasers/map_export.hpp"

namespace urban_nav {

/// Returns the ground of a map in the axes of an export.
laser_mapper::GroundGrid findGround(const laser_mapper::LaserMap& map, const MappedSessions& mapped,
                                    const MapAxes& axes);

/// Writes the files of planners that `paths` names: the occupancy grid of map_server, and GeoTIFF files of elevation,
/// slope and traversability. The YAML of the grid is in the frame map; in a coordinate system the columns of the image
/// point north there, and a world file FILE.pgw with FILE.prj is next to the image. `ground`: of findGround() in the
/// same axes. Throws UserError naming the path.
void writeGroundFiles(const MapFilePaths& paths, const laser_mapper::LaserMap& map, const MappedSessions& mapped,
                      const MapAxes& axes, const laser_mapper::GroundGrid& ground);

}  // namespace urban_nav
