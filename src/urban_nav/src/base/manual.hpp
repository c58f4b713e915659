// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/command.hpp"

namespace urban_nav {

/// Returns the man page of the program (man 1, in roff), from the options and sentences that --help prints.
std::string printManual(const std::vector<Command>& commands);

/// Returns completion for bash: commands, actions, options and the allowed words of options; files elsewhere.
std::string printCompletion(const std::vector<Command>& commands);

}  // namespace urban_nav
