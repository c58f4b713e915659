// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/command.hpp"
#include "base/json.hpp"

namespace urban_nav {

/// Returns a command that writes one store, or release, from several; without name, summary, examples and run.
Command storesCommand(bool is_output_required);

/// Throws DataError naming the session if a store has one of an unfinished run of `map`; sessions recorded live count
/// as finished. Throws the errors of urban_nav_store.
void requireFinished(const std::string& store);

/// Writes a summary to the file of --json, if given.
void writeSummary(const Arguments& arguments, const Json& json);

}  // namespace urban_nav
