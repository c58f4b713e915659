// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/command.hpp"

namespace urban_nav {

/// Returns the subcommands (docs/files.md), in the order of `urban_nav --help`.
std::vector<Command> allCommands();

}  // namespace urban_nav
