// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Returns the bytes of a command to a device from words such as {"velocity", "0.5", "0"}. Throws UserError with the
/// commands of the kind, or the kinds.
Bytes encodeCommand(const std::string& kind, const std::vector<std::string>& words);

}  // namespace segway_drivers
