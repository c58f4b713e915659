// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_registration/cloud/surfels.hpp"

namespace urban_nav_registration {

/// Vertical direction and ground of a cloud.
struct UpDirection {
  Eigen::Vector3f up =
      Eigen::Vector3f::UnitZ();  ///< opposite to gravity as estimated from the ground, in the cloud's frame
  float ground = 0.0F;           ///< height of the ground around the sensor, m along `up`
  bool has_ground = false;
};

/// Returns the most frequent direction of normals within 35 deg of z, and the most frequent height of these surfaces
/// near the sensor.
UpDirection estimateUpDirection(const Surfels& surfels);

}  // namespace urban_nav_registration
