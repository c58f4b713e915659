// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "urban_nav_sim/device/simulated_device.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav {

struct SimulateDeviceJob {
  std::string kind;  ///< lms291, xsens_mti, segway_rmp, gps
  std::string bag;   ///< recorded session; empty: `session` is simulated first
  urban_nav_sim::SessionOptions session;
  std::string side = "left";  ///< of lms291
  std::string link;           ///< path of the port
  int tcp = 0;                ///< gps: serve gpsd's protocol at this port instead
  std::string truth;          ///< file of `sequence,true_ns`, or empty
  std::string begin;          ///< file in which devices agree on the begin of the session; empty: at once
  urban_nav_sim::DeviceOptions options;
};

/// Runs a simulated device until its session ends or `stop` returns true, then writes the truth. Returns the number of
/// measurements. Throws UserError for a wrong job, DataError if the port cannot be made.
std::int64_t simulateDevice(const SimulateDeviceJob& job, const std::function<bool()>& stop);

}  // namespace urban_nav
