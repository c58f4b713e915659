// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "laser_mapper/georeference/georeference.hpp"
#include "laser_mapper/georeference/map_projection.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Coordinate system of an exported map, and the pose of the map in it.
class MapCrs {
 public:
  /// `crs`: "auto" (the UTM zone of the fixes) or "EPSG:N". Throws UserError for other text, DataError with the reason
  /// if the GPS fixes of the sessions do not georeference the map.
  MapCrs(const std::string& crs, urban_nav_store::Store& store,
         const std::vector<urban_nav_store::StoredTrajectory>& map);

  /// Returns easting, northing and the height over the ellipsoid of a point of the map.
  Eigen::Vector3d project(const Eigen::Vector3d& p_map) const;
  /// Returns the point of the map at a position.
  Eigen::Vector3d toMap(const laser_mapper::Geodetic& position) const;
  const laser_mapper::GeoReference& reference() const { return reference_; }
  int epsg() const { return epsg_; }
  const std::string& wkt() const { return projection_->wkt(); }
  /// Returns a sentence for the user: system, fixes, uncertainty.
  std::string describe() const;

 private:
  int epsg_ = 0;
  laser_mapper::GeoReference reference_;
  std::optional<urban_nav_core::LocalTangent> tangent_;
  std::unique_ptr<laser_mapper::MapProjection> projection_;
};

/// Returns the code of "EPSG:N"; 0 for "auto". Throws UserError for other text.
int parseCrs(const std::string& crs);

}  // namespace urban_nav
