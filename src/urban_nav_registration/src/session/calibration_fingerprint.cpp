// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/calibration_fingerprint.hpp"

#include <cmath>
#include <sstream>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav_registration {

namespace {

constexpr double rounding = 1e-6;  // px, m; of a quaternion

}  // namespace

std::string calibrationFingerprint(const urban_nav_core::StereoCamera& camera,
                                   const urban_nav_core::Pose& T_base_left) {
  std::string words = std::to_string(camera.left.width) + "x" + std::to_string(camera.left.height);
  for (const double value : {camera.left.fx, camera.left.fy, camera.left.cx, camera.left.cy, camera.baseline,
                             T_base_left.t().x(), T_base_left.t().y(), T_base_left.t().z(), T_base_left.q().x(),
                             T_base_left.q().y(), T_base_left.q().z(), T_base_left.q().w()})
    words += " " + urban_nav_core::printNumber(value);
  return words;
}

bool isSameCalibration(const std::string& words, const std::string& others) {
  if (words == others) return true;
  std::istringstream a(words), b(others);
  std::string of_a, of_b;
  for (;;) {
    const bool more_a = static_cast<bool>(a >> of_a), more_b = static_cast<bool>(b >> of_b);
    if (!more_a || !more_b) return more_a == more_b;
    if (of_a == of_b) continue;
    const auto number_a = urban_nav_core::parseNumber(of_a), number_b = urban_nav_core::parseNumber(of_b);
    if (!number_a || !number_b || !(std::abs(*number_a - *number_b) <= rounding)) return false;
  }
}

}  // namespace urban_nav_registration
