// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace segway_drivers {

/// Returns the quaternion w x y z of a row-major rotation matrix.
std::array<double, 4> mtiQuaternionFromMatrix(const std::array<double, 9>& matrix);
/// Returns the quaternion w x y z of roll, pitch and yaw, deg.
std::array<double, 4> mtiQuaternionFromEuler(double roll, double pitch, double yaw);

}  // namespace segway_drivers
