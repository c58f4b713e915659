// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "segway_drivers/transport/port.hpp"

namespace segway_drivers {

/// Returns the steady time, ns, at which the sessions of all simulated devices begin that name the same file: the first
/// one writes `in` ns from now, the others read it. The file must be new for each launch. Throws UserError if it cannot
/// be made or read.
TimeNs agreeOnBegin(const std::string& path, TimeNs in);

}  // namespace segway_drivers
