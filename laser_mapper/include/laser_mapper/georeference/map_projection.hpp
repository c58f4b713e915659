// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "urban_nav_core/geometry/geodetic.hpp"

namespace laser_mapper {

using urban_nav_core::Geodetic;

/// Returns the EPSG code of the UTM zone of a position (WGS 84); 0 within 6 deg of a pole, where none is defined.
int utmZoneCode(const Geodetic& position);

/// Projected coordinate system given by its EPSG code. Not thread-safe.
class MapProjection {
 public:
  /// Throws UserError naming `option` if there is no such system, or if its axes are not lengths in metres.
  MapProjection(int epsg, const std::string& option);
  ~MapProjection();
  MapProjection(const MapProjection&) = delete;
  MapProjection& operator=(const MapProjection&) = delete;

  /// Returns easting, northing and ellipsoidal height, m. Throws DataError outside the area of the system.
  Eigen::Vector3d project(const Geodetic& position) const;
  /// Returns the position of an easting, a northing and a height. Throws DataError outside the area of the system.
  Geodetic unproject(const Eigen::Vector3d& p) const;
  /// Returns the system as well-known text of 2001, the format of LAS files.
  const std::string& wkt() const { return wkt_; }
  /// Returns the system as the well-known text of ESRI, the format of .prj files.
  const std::string& esriWkt() const { return esri_wkt_; }
  const std::string& name() const { return name_; }

 private:
  struct Proj;
  std::unique_ptr<Proj> proj_;
  std::string wkt_, esri_wkt_, name_;
};

}  // namespace laser_mapper
