// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"

namespace laser_mapper {

/// Returns the columns of map.ply (docs/files.md).
urban_nav_core::PlyLayout mapLayout();

/// Appends the bytes of a vertex of mapLayout().
void appendVertex(std::string& bytes, const MapPoint& point);

}  // namespace laser_mapper
