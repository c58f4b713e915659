// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "urban_nav/run_listener.hpp"

namespace urban_nav {

/// Values of arguments by name: options by their long name without dashes ("out"), positionals by their name
/// ("INPUT"). A flag has the value "true".
using NamedArguments = std::map<std::string, std::vector<std::string>>;

/// Runs a subcommand of `urban_nav`, or an action of one ("places query"), in this process. Returns its exit status, 0
/// or 1. Throws UserError if the command would end with status 2, DataError if the data are unsuitable. Not
/// thread-safe: one run at a time.
int runCommand(const std::string& name, const NamedArguments& arguments, RunListener& listener);

}  // namespace urban_nav
