// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/geodetic.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace laser_mapper {

using urban_nav_core::Geodetic;

/// Position of the robot's antenna measured by GPS.
struct AntennaFix {
  urban_nav_core::StampNs stamp = 0;
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();  ///< m, antenna in the map
  Geodetic measured;
  Eigen::Vector3d sigma = Eigen::Vector3d::Ones();  ///< m, east, north, up, as stated by the receiver
};

/// Position of a map on the earth. Standard deviations are those at the centre of the fixes.
struct GeoReference {
  Geodetic origin;                   ///< of the local axes
  urban_nav_core::Pose T_local_map;  ///< to axes east, north, up at the origin: a rotation about the vertical and a
                                     ///< translation
  std::size_t fixes = 0;
  double residual = 0.0;        ///< m, median horizontal distance of the fixes from the trajectory
  double position_sigma = 0.0;  ///< m, in each horizontal direction
  double height_sigma = 0.0;    ///< m
  double heading_sigma = 0.0;   ///< rad
};

/// Georeference, or the reason why there is none.
struct GeoFit {
  std::optional<GeoReference> reference;
  std::string reason;
};

/// Fits a level map to GPS fixes at scale 1, robustly: fixes with multipath errors are down-weighted. Receiver errors
/// are correlated over minutes, so the stated standard deviations decrease with duration and with the number of turns
/// of the path rather than with the number of fixes. Returns no reference with fewer than ten fixes, or if the heading
/// would be uncertain by more than 3 deg.
GeoFit fitGeoReference(const std::vector<AntennaFix>& fixes);

}  // namespace laser_mapper
