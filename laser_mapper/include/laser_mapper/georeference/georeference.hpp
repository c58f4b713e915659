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

/// A position of the robot's antenna that GPS measured.
struct AntennaFix {
  urban_nav_core::StampNs stamp = 0;
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();  ///< m, of the antenna, in the map
  Geodetic measured;
  Eigen::Vector3d sigma = Eigen::Vector3d::Ones();  ///< m, east, north, up, as the receiver states them
};

/// Where a map lies on the earth. Standard deviations hold for the middle of the fixes.
struct GeoReference {
  Geodetic origin;                   ///< of the local axes
  urban_nav_core::Pose T_local_map;  ///< to axes east, north, up at the origin: a turn about the vertical and a shift
  std::size_t fixes = 0;
  double residual = 0.0;        ///< m, median horizontal distance of the fixes from the trajectory
  double position_sigma = 0.0;  ///< m, in each horizontal direction
  double height_sigma = 0.0;    ///< m
  double heading_sigma = 0.0;   ///< rad
};

/// A georeference, or the reason why there is none.
struct GeoFit {
  std::optional<GeoReference> reference;
  std::string reason;
};

/// Fits a level map to GPS fixes at scale 1, robustly: fixes off by reflections lose their weight. Errors of a receiver
/// last for minutes, hence the stated standard deviations do not fall with the number of fixes, but with the duration
/// and with how often the path has turned.
/// Without a reference if there are fewer than ten fixes, or if the heading would be uncertain by more than 3 deg.
/// Thread-safe.
GeoFit fitGeoReference(const std::vector<AntennaFix>& fixes);

}  // namespace laser_mapper
