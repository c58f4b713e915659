// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "urban_nav/run_listener.hpp"

namespace urban_nav {

/// Values of options by their long names without dashes ("out"), of positional arguments by theirs ("INPUT"). A flag
/// has the value "true".
using NamedArguments = std::map<std::string, std::vector<std::string>>;

/// Runs a subcommand of `urban_nav`, or an action of one ("places query"), in this process. Returns its exit status, 0
/// or 1. Throws UserError where the command would end with status 2, DataError where the data are unsuitable. Not
/// thread-safe: one run at a time.
int runCommand(const std::string& name, const NamedArguments& arguments, RunListener& listener);

}  // namespace urban_nav
