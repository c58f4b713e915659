// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/json.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav {

/// Appends the inputs of a session to an array: role, topic, frame and messages; of 3D LiDARs also points_time,
/// sweep_s, rings and deskewed.
void appendInputs(const std::vector<urban_nav_input::InputStream>& inputs, Json& array);

}  // namespace urban_nav
