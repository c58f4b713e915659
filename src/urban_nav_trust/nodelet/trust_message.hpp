// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urban_nav_msgs/Trust.h>

#include <string>

#include "live/live_trust.hpp"

namespace urban_nav_trust {

urban_nav_msgs::Trust toMessage(const LiveEstimate& estimate, const Parameters& parameters,
                                const std::string& map_frame);

}  // namespace urban_nav_trust
