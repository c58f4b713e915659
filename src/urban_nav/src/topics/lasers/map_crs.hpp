// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "laser_mapper/georeference/control_points.hpp"
#include "laser_mapper/georeference/georeference.hpp"
#include "laser_mapper/georeference/map_projection.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Coordinate system of an exported map, and the pose of the map in it.
class MapCrs {
 public:
  /// `crs`: "auto" (the UTM zone of the fixes) or "EPSG:N". `control`: CSV file of surveyed points, see
  /// readControlPoints(), in place of the GPS fixes; empty: none. Throws UserError for other text and for a file that
  /// cannot be read, DataError with the reason if fixes or points do not georeference the map.
  MapCrs(const std::string& crs, const std::string& control, urban_nav_store::Store& store,
         const std::vector<urban_nav_store::StoredTrajectory>& map);

  /// Returns easting, northing and the height over the ellipsoid of a point of the map.
  Eigen::Vector3d project(const Eigen::Vector3d& p_map) const;
  /// Returns the point of the map at a position.
  Eigen::Vector3d toMap(const laser_mapper::Geodetic& position) const;
  /// Returns the point of the map at an easting, a northing and a height.
  Eigen::Vector3d unproject(const Eigen::Vector3d& p) const;
  const laser_mapper::GeoReference& reference() const { return reference_; }
  int epsg() const { return epsg_; }
  const std::string& name() const { return projection_->name(); }
  const std::string& wkt() const { return projection_->wkt(); }
  const std::string& esriWkt() const { return projection_->esriWkt(); }
  /// Surveyed point and its horizontal distance from the exported map.
  struct ControlError {
    std::string name;
    double error = 0.0;  ///< m
  };
  /// Returns the surveyed points; none if the map is placed by GPS fixes.
  const std::vector<ControlError>& control() const { return control_; }
  /// Returns a sentence for the user: system, fixes or points, uncertainty.
  std::string describe() const;

 private:
  laser_mapper::GeoFit fitFixes(urban_nav_store::Store& store,
                                const std::vector<urban_nav_store::StoredTrajectory>& map) const;
  laser_mapper::GeoFit fitControl(const std::string& file);

  int epsg_ = 0;
  std::vector<ControlError> control_;
  laser_mapper::GeoReference reference_;
  std::optional<urban_nav_core::LocalTangent> tangent_;
  std::unique_ptr<laser_mapper::MapProjection> projection_;
};

/// Returns the code of "EPSG:N"; 0 for "auto". Throws UserError for other text.
int parseCrs(const std::string& crs);

/// Returns the points of a CSV file with the columns name, x, y, z (easting, northing, height, m) and map_x, map_y,
/// map_z (m, in the frame map). Throws UserError with file and line.
std::vector<laser_mapper::ControlPoint> readControlPoints(const std::string& file,
                                                          const laser_mapper::MapProjection& projection);

}  // namespace urban_nav
