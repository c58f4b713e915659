// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"
#include "urban_nav_sim/device/simulated_device.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav {

/// Returns clock, delays, faults and seed of the simulated device from the options of `device simulate`. Throws
/// UserError.
urban_nav_sim::DeviceOptions simulatedDeviceOptions(const Arguments& arguments);

/// Returns the session that --world and its options describe, for jobs without --bag. Throws UserError if both are
/// missing.
urban_nav_sim::SessionOptions simulatedSession(const Arguments& arguments);

}  // namespace urban_nav
