// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"

namespace urban_nav {

/// Returns the command device with its actions: protocol cores and simulated devices.
Command deviceCommand();

}  // namespace urban_nav
