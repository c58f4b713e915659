// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/motion_input.hpp"

#include <ostream>

namespace urban_nav_core {

MotionChoice toMotionChoice(const std::string& motion_input) {
  if (motion_input == "auto") return {true, true, false};
  return {motion_input == "gyroscope", motion_input == "wheels", motion_input != "none"};
}

bool isApprox(const MotionInput& a, const MotionInput& b, double tolerance) {
  return a.source == b.source && a.q_base_sensor.angularDistance(b.q_base_sensor) <= tolerance && a.from == b.from &&
         a.to == b.to && isApprox(a.T_from_to, b.T_from_to, tolerance) &&
         ((a.information - b.information).array().abs() <= tolerance).all() &&
         (a.specific_force - b.specific_force).norm() <= tolerance;
}

std::ostream& operator<<(std::ostream& out, const MotionInput& value) {
  return out << printStamp(value.from) << " -> " << printStamp(value.to) << " s: " << value.T_from_to
             << ", information diagonal = (" << value.information.diagonal().transpose() << ")";
}

}  // namespace urban_nav_core
