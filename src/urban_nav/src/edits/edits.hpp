// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"
#include "map/stage_list.hpp"

namespace urban_nav {

/// Return the commands edge, which edits the map of a store, and verify, which recomputes and compares it.
Command edgeCommand();
Command verifyCommand(StageFactory make_stages);

}  // namespace urban_nav
