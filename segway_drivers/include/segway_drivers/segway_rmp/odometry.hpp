// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "segway_drivers/segway_rmp/units.hpp"

namespace segway_drivers {

/// Integrates the pose of the base in `odom` from the forward and yaw travel of message 0404; continuous across resets
/// of the base. Not thread-safe.
class RmpOdometry {
 public:
  struct Limits {
    double velocity = 4.0;   ///< m/s, a faster step is a jump
    double turn_rate = 4.0;  ///< rad/s
  };
  RmpOdometry() = default;
  explicit RmpOdometry(const Limits& limits, const RmpUnits& units = {}) : limits_(limits), units_(units) {}

  /// Adds a message 0404. `time` in ns. Returns false for a jump, which is counted and leaves the pose unchanged.
  bool add(const CanFrame& travel, TimeNs time);
  /// Continues from the current pose at the next message, as after a power cycle.
  void restart() { last_forward_.reset(); }

  double x() const { return x_; }
  double y() const { return y_; }
  double yaw() const { return yaw_; }
  double distance() const { return distance_; }  ///< m driven, forward and backward
  std::int64_t jumps() const { return jumps_; }

 private:
  Limits limits_{};
  RmpUnits units_{};
  std::optional<std::uint32_t> last_forward_;
  std::uint32_t last_yaw_ = 0;
  TimeNs last_time_ = 0;
  double x_ = 0.0, y_ = 0.0, yaw_ = 0.0, distance_ = 0.0;
  std::int64_t jumps_ = 0;
};

}  // namespace segway_drivers
