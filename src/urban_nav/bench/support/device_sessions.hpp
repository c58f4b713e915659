// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "segway_drivers/driver/driver_core.hpp"
#include "urban_nav_sim/device/simulated_device.hpp"

namespace urban_nav::bench {

/// A simulated serial device with its session, and its driver.
struct DeviceSession {
  std::string name;
  std::unique_ptr<urban_nav_sim::SimulatedDevice> device;
  std::unique_ptr<segway_drivers::DriverCore> driver;
  std::shared_ptr<std::int64_t> messages = std::make_shared<std::int64_t>(0);  ///< published by the driver
};

/// Calls `visit` with each of the five serial devices of the robot, with sessions of `seconds` s.
void forEachSerialDevice(double seconds, const std::function<void(DeviceSession&)>& visit);

}  // namespace urban_nav::bench
