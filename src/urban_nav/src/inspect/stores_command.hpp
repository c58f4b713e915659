// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/command.hpp"
#include "base/json.hpp"

namespace urban_nav {

/// Returns a command that makes one store, or release, of several; without its name, summary, examples and run.
Command storesCommand(bool is_output_required);

/// Throws DataError naming the session if a store holds one that a run of `map` has begun and not finished; that of a
/// robot is as complete as it will ever be. Throws the errors of urban_nav_store.
void requireFinished(const std::string& store);

/// Writes a summary to the file of --json, if that is given.
void writeSummary(const Arguments& arguments, const Json& json);

}  // namespace urban_nav
