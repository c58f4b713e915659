// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Normal of the ground measured by a camera at a time.
struct GroundNormal {
  StampNs stamp = 0;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit vector in the axes of base_link, away from the ground
  double sigma = 0.0;                             ///< rad, standard deviation of its direction
  double height = 0.0;                            ///< m, of the origin of base_link above the plane
  double support = 0.0;                           ///< share of the ground's area on the plane
};

}  // namespace urban_nav_core
