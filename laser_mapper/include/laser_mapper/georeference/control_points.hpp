// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "laser_mapper/georeference/georeference.hpp"

namespace laser_mapper {

/// Surveyed point that is recognised in the map.
struct ControlPoint {
  std::string name;
  Geodetic surveyed;
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();  ///< m
};

/// Georeference by surveyed points, or the reason why it is missing.
struct ControlFit {
  GeoFit fit;
  std::vector<double> errors;  ///< m, horizontal distance of each point from its surveyed position
};

/// Fits a level map to surveyed points at scale 1 by least squares, with equal weights. Standard deviations are stated
/// from the residuals; with two points, from the difference of their distances. Returns no reference for fewer than two
/// points, if all are at one place, or if the map has another shape than the points, such as where two names or
/// coordinates are exchanged.
ControlFit fitControlPoints(const std::vector<ControlPoint>& points);

}  // namespace laser_mapper
