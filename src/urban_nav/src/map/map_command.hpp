// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"
#include "map/stage_list.hpp"

namespace urban_nav {

/// Returns the command map, which runs these stages.
Command mapCommand(StageFactory make_stages);

}  // namespace urban_nav
