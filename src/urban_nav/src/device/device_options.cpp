// SPDX-License-Identifier: BSD-3-Clause
#include "device/device_options.hpp"

#include <cstdint>
#include <string>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

urban_nav_sim::DeviceOptions simulatedDeviceOptions(const Arguments& arguments) {
  urban_nav_sim::DeviceOptions options;
  options.seed = static_cast<std::uint64_t>(arguments.integer("seed", 1, 0, 4294967295));
  for (const std::string& fault : arguments.all("fault"))
    options.faults.push_back(urban_nav_sim::parseDeviceFault(fault));
  if (arguments.has("clock")) options.clock = urban_nav_sim::DeviceClock::parse(arguments.get("clock"));
  if (arguments.has("delay")) options.delay = urban_nav_sim::DelayModel::parse(arguments.get("delay"), 1.0);
  return options;
}

urban_nav_sim::SessionOptions simulatedSession(const Arguments& arguments) {
  if (!arguments.has("bag") && !arguments.has("world"))
    throw UserError("urban_nav device", "--bag is missing", "--bag BAG, or --world W");
  urban_nav_sim::SessionOptions session;
  session.world = arguments.get("world", session.world);
  session.route = arguments.get("route", session.route);
  session.day = static_cast<int>(arguments.integer("day", 1, 1, 100000));
  session.light = urban_nav_sim::parseLight(arguments.get("light", "day"));
  session.duration = arguments.number("duration", session.duration, 0.1, 86400.0);
  session.seed = static_cast<std::uint32_t>(arguments.integer("seed", 1, 0, 4294967295));
  return session;
}

}  // namespace urban_nav
