// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "urban_nav_core/types/stamp.hpp"

namespace laser_mapper {

/// Point of the map: mean of the beams that hit the surface there.
struct MapPoint {
  Eigen::Vector3f p = Eigen::Vector3f::Zero();       ///< m, in the map
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the laser; zero without a surface
  float sigma = 0.0F;                                ///< m, standard deviation of the distance to the surface
  std::uint8_t red = 0, green = 0, blue = 0;
  std::uint8_t intensity = 0;      ///< reflectance, normalised for range and incidence
  std::uint8_t raw_intensity = 0;  ///< as measured
  std::uint8_t laser = 0;          ///< sensor id (sensors.hpp): 0 left, 1 right, 255 stereo
  bool is_coloured = false;        ///< red, green, blue are from a camera, not the grey level of `intensity`
  std::uint16_t pass = 0;          ///< pass of most of the beams
  std::uint16_t count = 0;         ///< beams
  float range = 0.0F;              ///< m, mean
  float displacement = -1.0F;      ///< m, mean between passes that measured the plane at this point; negative: unknown
  urban_nav_core::StampNs stamp = 0;
};

}  // namespace laser_mapper
