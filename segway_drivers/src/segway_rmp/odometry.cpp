// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/segway_rmp/odometry.hpp"

#include <algorithm>
#include <cmath>

namespace segway_drivers {

namespace {

constexpr double kRmpFullTurn = 6.283185307179586;
constexpr double kRmpLeastStep = 0.02;  // s, so that late messages do not appear as jumps

}  // namespace

bool RmpOdometry::add(const CanFrame& travel, TimeNs time) {
  const std::uint32_t forward = travel.pair(0), yaw = travel.pair(2);
  bool good = true;
  if (last_forward_) {
    // Counters wrap: unsigned subtraction, signed result.
    const double step = static_cast<std::int32_t>(forward - *last_forward_) / units_.per_metre;
    const double turn = kRmpFullTurn * static_cast<std::int32_t>(yaw - last_yaw_) / units_.per_revolution;
    const double elapsed = std::max(1e-9 * static_cast<double>(time - last_time_), kRmpLeastStep);
    good = std::abs(step) <= limits_.velocity * elapsed && std::abs(turn) <= limits_.turn_rate * elapsed;
    if (good) {
      x_ += step * std::cos(yaw_ + 0.5 * turn);
      y_ += step * std::sin(yaw_ + 0.5 * turn);
      yaw_ = std::remainder(yaw_ + turn, kRmpFullTurn);
      distance_ += std::abs(step);
    } else {
      ++jumps_;
    }
  }
  last_forward_ = forward;
  last_yaw_ = yaw;
  last_time_ = time;
  return good;
}

}  // namespace segway_drivers
