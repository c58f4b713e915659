// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_registration/cloud/surfels.hpp"

namespace urban_nav_registration {

/// How a cloud stands.
struct UpDirection {
  Eigen::Vector3f up =
      Eigen::Vector3f::UnitZ();  ///< against gravity as far as the ground shows it, in the cloud's frame
  float ground = 0.0F;           ///< height of the ground around the sensor, m along `up`
  bool has_ground = false;
};

/// The direction within 35 deg of z that most normals share, and the height at which most of those surfaces near the
/// sensor lie.
UpDirection estimateUpDirection(const Surfels& surfels);

}  // namespace urban_nav_registration
