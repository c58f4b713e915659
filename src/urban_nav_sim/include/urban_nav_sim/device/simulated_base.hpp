// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_sim/device/simulated_device.hpp"

namespace urban_nav_sim {

/// Motion of a session measured by the wheels.
struct WheelReading {
  double time = 0.0;      ///< s since the begin of the session
  double velocity = 0.0;  ///< m/s
  double yaw_rate = 0.0;  ///< rad/s
};

/// An RMP200 over USB: eight packets every 10 ms with the motion of the session. Keeps a command for 400 ms, according
/// to its message 0407.
class SimulatedBase : public SimulatedDevice {
 public:
  SimulatedBase(std::vector<WheelReading> readings, const DeviceOptions& options);

 private:
  void takeByte(std::uint8_t byte) override;
  bool measure(double t) override;
  void boot() override;
  DeviceBytes cyclePackets() const;

  std::vector<WheelReading> readings_;
  std::size_t next_ = 0;
  std::int64_t cycle_ = 0;
  double velocity_ = 0.0, yaw_rate_ = 0.0, forward_ = 0.0, yaw_ = 0.0, commanded_at_ = -1.0;
  unsigned servo_frames_ = 0, command_velocity_ = 0, command_turn_ = 0, mode_ = 1;
  DeviceBytes pending_;
};

}  // namespace urban_nav_sim
