// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Specific force measured by an accelerometer, in the axes of base_link, m/s2. At rest it is 9.8 upwards, as in
/// sensor_msgs/Imu.
struct SpecificForce {
  StampNs stamp = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

}  // namespace urban_nav_core
