// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace urban_nav_core {

/// A position in WGS 84.
struct Geodetic {
  double latitude = 0.0, longitude = 0.0;  ///< rad
  double height = 0.0;                     ///< m above the ellipsoid
};

/// Cartesian axes east, north and up at a point of the ellipsoid, without map distortion (EPSG method 9837). Immutable,
/// hence thread-safe.
class LocalTangent {
 public:
  explicit LocalTangent(const Geodetic& origin);

  Eigen::Vector3d toLocal(const Geodetic& position) const;
  /// Returns the position in WGS 84, to 0.1 mm for heights between -5 km and 20 km.
  Geodetic toGeodetic(const Eigen::Vector3d& local) const;

 private:
  Eigen::Vector3d origin_;  ///< m, earth-centred
  Eigen::Matrix3d R_local_earth_;
};

}  // namespace urban_nav_core
