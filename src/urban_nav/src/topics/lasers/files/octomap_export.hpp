// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "laser_mapper/laser_map.hpp"
#include "topics/lasers/files/mapped_sessions.hpp"

namespace urban_nav {

/// Writes the space of a map as an OctoMap (.bt) of cubes of 0.1 m in the frame map. Throws UserError naming the path.
void writeOctomap(const std::string& path, const laser_mapper::LaserMap& map, const MappedSessions& mapped);

}  // namespace urban_nav
