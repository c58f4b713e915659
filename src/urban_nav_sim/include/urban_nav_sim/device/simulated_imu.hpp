// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "urban_nav_sim/device/simulated_device.hpp"

namespace urban_nav_sim {

/// Sample of a session in the axes of the sensor.
struct ImuReading {
  double time = 0.0;                                      ///< s since the begin of the session
  std::array<double, 3> acceleration{}, rate{}, field{};  ///< m/s^2 with gravity, rad/s, units of the earth's field
  std::array<double, 4> orientation{1, 0, 0, 0};          ///< w x y z, sensor to ENU
};

/// An MTi of 2008 with MTData: calibrated data, quaternion and counter. Starts in measurement at 115 200 baud.
class SimulatedImu : public SimulatedDevice {
 public:
  SimulatedImu(std::vector<ImuReading> readings, const DeviceOptions& options);

 private:
  void takeByte(std::uint8_t byte) override;
  bool measure(double t) override;
  void boot() override;
  void answer(std::uint8_t mid, const DeviceBytes& data);
  /// Answers a request to read a setting, or to write it if there are data.
  void answerSetting(std::uint8_t mid, DeviceBytes& setting, const DeviceBytes& data);

  std::vector<ImuReading> readings_;
  std::size_t next_ = 0;
  std::int64_t sequence_ = 0;
  unsigned counter_ = 0;
  bool measures_ = true, restarted_ = false;
  DeviceBytes pending_, mode_{0, 6}, settings_{0, 0, 0, 1}, period_{0x04, 0x80}, skip_{0, 0};
};

}  // namespace urban_nav_sim
