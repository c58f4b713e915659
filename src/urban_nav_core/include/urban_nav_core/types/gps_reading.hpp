// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/geodetic.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Position measured by a GPS receiver.
struct GpsReading {
  StampNs stamp = 0;
  double latitude = 0.0, longitude = 0.0;  ///< deg, WGS 84
  double height = 0.0;                     ///< m above the ellipsoid
  Vector3d sigma = Vector3d::Ones();       ///< m, east, north, up, as stated by the receiver

  Geodetic position() const {
    constexpr double kToRad = 3.14159265358979323846 / 180.0;
    return {kToRad * latitude, kToRad * longitude, height};
  }
};

/// Position of the robot's antenna.
struct PositionFix {
  GpsReading reading;
  Vector3d p_base = Vector3d::Zero();  ///< m, antenna in base_link
};

}  // namespace urban_nav_core
