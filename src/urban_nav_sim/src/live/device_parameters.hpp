// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_sim/device/run_simulated_device.hpp"

namespace urban_nav_sim {

/// Parameters of a simulated device in a nodelet: the options of `urban_nav device simulate`. One member per row of
/// deviceTable().
struct DeviceParameters {
  std::string kind, bag, side, link;
  int tcp;            // port, 0: none
  std::string fault;  // faults for parseDeviceFault()
  std::string clock, delay;
  std::string begin, truth;
  bool held;
  int seed;

  DeviceParameters();
};

const urban_nav_core::Table<DeviceParameters>& deviceTable();

/// Throws UserError for a missing bag or link, and for an invalid fault, clock or delay, naming the key after `where`
/// ("/laser/").
SimulatedDeviceJob simulatedDeviceJob(const DeviceParameters& parameters, const std::string& where);

}  // namespace urban_nav_sim
