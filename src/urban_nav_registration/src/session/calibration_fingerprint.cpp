// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/calibration_fingerprint.hpp"

#include <cmath>
#include <sstream>
#include <vector>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav_registration {

namespace {

constexpr double kQuaternionTolerance = 1e-3;
constexpr double kRounding = 1e-6;  // px, m, and quaternion elements

}  // namespace

std::string calibrationFingerprint(const urban_nav_core::StereoCamera& camera,
                                   const urban_nav_core::Pose& T_base_left) {
  std::string words = std::to_string(camera.left.width) + "x" + std::to_string(camera.left.height);
  for (const double value : {camera.left.fx, camera.left.fy, camera.left.cx, camera.left.cy, camera.baseline,
                             T_base_left.t().x(), T_base_left.t().y(), T_base_left.t().z(), T_base_left.q().x(),
                             T_base_left.q().y(), T_base_left.q().z(), T_base_left.q().w()})
    words += " " + urban_nav_core::printNumber(value);
  if (camera.disparity_offset != 0.0) words += " " + urban_nav_core::printNumber(camera.disparity_offset);
  return words;
}

std::optional<MountedCamera> parseCalibrationFingerprint(const std::string& words) {
  constexpr std::size_t kFewestValues = 12;  // one more with a disparity offset
  MountedCamera result;
  urban_nav_core::Pinhole& left = result.camera.left;
  std::istringstream text(words);
  std::string word;
  char by = 0;
  if (!(text >> left.width >> by >> left.height) || by != 'x' || left.width <= 0 || left.height <= 0)
    return std::nullopt;
  std::vector<double> values;
  while (text >> word) {
    const auto value = urban_nav_core::parseNumber(word);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    values.push_back(*value);
  }
  if (values.size() != kFewestValues && values.size() != kFewestValues + 1) return std::nullopt;
  left.fx = values[0], left.fy = values[1], left.cx = values[2], left.cy = values[3];
  result.camera.baseline = values[4];
  if (!(left.fx > 0.0) || !(left.fy > 0.0) || !(result.camera.baseline > 0.0)) return std::nullopt;
  const Eigen::Quaterniond q(values[11], values[8], values[9], values[10]);
  if (!(std::abs(q.norm() - 1.0) < kQuaternionTolerance)) return std::nullopt;
  result.T_base_left = urban_nav_core::Pose(q, {values[5], values[6], values[7]});
  if (values.size() > kFewestValues) result.camera.disparity_offset = values[12];
  return result;
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
    if (!number_a || !number_b || !(std::abs(*number_a - *number_b) <= kRounding)) return false;
  }
}

}  // namespace urban_nav_registration
