// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "laser_mapper/mesh/surface_mesh.hpp"
#include "topics/lasers/files/map_axes.hpp"

namespace urban_nav {

/// Writes a mesh, which is in the frame map, as PLY in the axes of an export; in a coordinate system also FILE.json
/// {`crs`: "EPSG:N", `offset`: what to add to its vertices, m}. Throws UserError naming the path.
void writeMesh(const std::string& path, laser_mapper::TriangleMesh mesh, const MapAxes& axes);

}  // namespace urban_nav
