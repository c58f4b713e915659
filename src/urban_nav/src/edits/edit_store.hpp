// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/json.hpp"
#include "edits/edit_run.hpp"

namespace urban_nav {

/// An edit as it was requested, and its effect.
struct EditResult {
  EditRequest request;
  EditOutcome outcome;
};

/// Makes the edit that the arguments of `urban_nav edge STORE ACTION ...` request; the command and the page call it.
/// The request is read from a store that is open for reading, so that what is refused leaves it as it is.
/// Throws UserError for what the command refuses with exit status 2; DataError if another program writes the store.
EditResult editStore(const Arguments& arguments);

/// Returns what the command prints of an edit.
std::string describe(const EditResult& result);
/// Returns the summary of --json.
Json toJson(const EditOutcome& outcome);

}  // namespace urban_nav
