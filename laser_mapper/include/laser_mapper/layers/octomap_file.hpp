// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "laser_mapper/layers/space_grid.hpp"

namespace laser_mapper {

/// Octree of space in the format of OctoMap (.bt: Hornung et al. 2013), and its size.
struct OctomapText {
  std::string bytes;
  std::size_t nodes = 0, free = 0, occupied = 0;  ///< nodes, and leaves by state
};

/// Prints space as an octree of OctoMap; eight equal cubes are one of twice the edge. Cubes beyond the 65 536 per axis
/// that OctoMap holds (3.2 km from the origin at 0.1 m) are left out.
OctomapText printOctomap(const SpaceGrid& space);

}  // namespace laser_mapper
