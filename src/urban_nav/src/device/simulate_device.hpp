// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "urban_nav_sim/device/run_simulated_device.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav {

/// A simulated device and its session.
struct SimulateDeviceJob {
  std::string bag;  ///< recorded session; empty: `session` is simulated first
  urban_nav_sim::SessionOptions session;
  std::string side = "left";  ///< of an lms291
  urban_nav_sim::SimulatedDeviceJob device;
};

/// Runs a simulated device until its session ends or `stop` returns true, then writes the truth. Returns the number of
/// measurements. Throws UserError for an invalid job, DataError if the port cannot be created.
std::int64_t simulateDevice(const SimulateDeviceJob& job, const std::function<bool()>& stop);

}  // namespace urban_nav
