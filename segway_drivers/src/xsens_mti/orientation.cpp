// SPDX-License-Identifier: BSD-3-Clause
#include "xsens_mti/orientation.hpp"

#include <algorithm>
#include <cmath>

#include "segway_drivers/xsens_mti/sample.hpp"

namespace segway_drivers {

namespace {

using MtiQuaternion = std::array<double, 4>;

MtiQuaternion multiplyMti(const MtiQuaternion& a, const MtiQuaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

}  // namespace

MtiQuaternion mtiQuaternionFromMatrix(const std::array<double, 9>& m) {
  const double trace = m[0] + m[4] + m[8];
  // The largest of the four components is computed by a square root, the others by division.
  const std::array<double, 4> squares = {1 + trace, 1 + m[0] - m[4] - m[8], 1 - m[0] + m[4] - m[8],
                                         1 - m[0] - m[4] + m[8]};
  const auto largest = std::max_element(squares.begin(), squares.end()) - squares.begin();
  const double root = 0.5 * std::sqrt(std::max(squares[static_cast<std::size_t>(largest)], 1e-12)), q = 0.25 / root;
  switch (largest) {
    case 0: return {root, q * (m[7] - m[5]), q * (m[2] - m[6]), q * (m[3] - m[1])};
    case 1: return {q * (m[7] - m[5]), root, q * (m[1] + m[3]), q * (m[2] + m[6])};
    case 2: return {q * (m[2] - m[6]), q * (m[1] + m[3]), root, q * (m[5] + m[7])};
    default: return {q * (m[3] - m[1]), q * (m[2] + m[6]), q * (m[5] + m[7]), root};
  }
}

MtiQuaternion mtiQuaternionFromEuler(double roll, double pitch, double yaw) {
  const double half = 0.5 * 3.14159265358979323846 / 180.0;
  const MtiQuaternion x = {std::cos(half * roll), std::sin(half * roll), 0, 0};
  const MtiQuaternion y = {std::cos(half * pitch), 0, std::sin(half * pitch), 0};
  const MtiQuaternion z = {std::cos(half * yaw), 0, 0, std::sin(half * yaw)};
  return multiplyMti(z, multiplyMti(y, x));
}

std::optional<MtiQuaternion> mtiOrientationEnu(const MtiSample& sample) {
  if (!sample.orientation) return std::nullopt;
  const double h = std::sqrt(0.5);
  switch (sample.earth) {
    case MtiSample::Earth::Enu: return sample.orientation;
    case MtiSample::Earth::Nwu: return multiplyMti({h, 0, 0, h}, *sample.orientation);
    case MtiSample::Earth::Ned: return multiplyMti({0, h, h, 0}, *sample.orientation);
  }
  return std::nullopt;
}

}  // namespace segway_drivers
