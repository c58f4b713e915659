// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "laser_mapper/sensors.hpp"
#include "urban_nav_core/io/cloud/las_writer.hpp"
#include "urban_nav_core/io/cloud/pcd_writer.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"

namespace laser_mapper {

/// Returns the columns of map.ply (docs/files.md). The header has a line `comment sensor ID ROLE FRAME` for each
/// sensor.
urban_nav_core::PlyLayout mapLayout(const std::vector<SensorName>& sensors = {});

/// Appends the bytes of a vertex of mapLayout().
void appendVertex(std::string& bytes, const MapPoint& point);

/// Returns the fields of a map as PCD, with the names of PCL (Rusu and Cousins 2011).
std::vector<urban_nav_core::PcdField> mapPcdFields();
/// Appends the bytes of a point of mapPcdFields().
void appendPcdPoint(std::string& bytes, const MapPoint& point);

/// Returns the attributes of a map in LAS files beyond those of the format.
std::vector<urban_nav_core::LasAttribute> mapLasAttributes();
/// Returns a point for LasWriter: the laser as scanner channel, the pass, counted from 1, as point source.
urban_nav_core::LasPoint lasPoint(const MapPoint& point);
/// Appends the values of mapLasAttributes().
void appendLasAttributes(std::string& bytes, const MapPoint& point);

}  // namespace laser_mapper
