// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Origin of a motion input.
enum class MotionSource {
  Given,      ///< a command, or a motion used without calibration
  Gyroscope,  ///< rates of an IMU: bias and noise are estimated
  Wheels,     ///< wheel odometry: scales are estimated
};

/// Motion sensors to be used with the images.
struct MotionChoice {
  bool gyroscope = false, wheels = false;
  bool is_required = false;  ///< selected explicitly: its absence is an error
  bool any() const { return gyroscope || wheels; }
};
/// Returns the choice of a parameter `motion_input`: auto (both if available), none, wheels, gyroscope.
MotionChoice toMotionChoice(const std::string& motion_input);

/// Command or measured motion u of the process model (Newman et al. 2009, section 2.1): motion of base_link between two
/// stamps. Components that the source does not observe (translation, for a gyroscope) have zero information.
struct MotionInput {
  StampNs from = 0;
  StampNs to = 0;
  Pose T_from_to;                           ///< of base_link
  Matrix6d information = Matrix6d::Zero();  ///< of (rho, phi) in `from`; may be singular. All zero: not stated
  MotionSource source = MotionSource::Given;
  Quaterniond q_base_sensor = Quaterniond::Identity();  ///< axes of the sensor in base_link
  /// Specific force of an IMU at `to` in the axes of base_link, m/s^2 (upwards at rest); zero: not measured.
  Vector3d specific_force = Vector3d::Zero();
};

bool isApprox(const MotionInput& a, const MotionInput& b, double tolerance);
std::ostream& operator<<(std::ostream& out, const MotionInput& value);

}  // namespace urban_nav_core
