// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace segway_drivers {

/// Quaternion w x y z of a rotation matrix given row by row.
std::array<double, 4> mtiQuaternionFromMatrix(const std::array<double, 9>& matrix);
/// Quaternion w x y z of roll, pitch and yaw, deg.
std::array<double, 4> mtiQuaternionFromEuler(double roll, double pitch, double yaw);

}  // namespace segway_drivers
