// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"

namespace urban_nav {

/// Returns the command simulate: drives the simulated robot and records its sensors.
Command simulateCommand();

}  // namespace urban_nav
