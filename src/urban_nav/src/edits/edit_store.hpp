// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/json.hpp"
#include "edits/edit_run.hpp"

namespace urban_nav {

/// A requested edit and its effect.
struct EditResult {
  EditRequest request;
  EditOutcome outcome;
};

/// Applies the edit requested by the arguments of `urban_nav edge STORE ACTION ...`; called by the command and the
/// page. The request is checked on a store opened for reading, so that a refused one does not change it. Throws
/// UserError for an invalid request (exit status 2); DataError if another program writes the store.
EditResult editStore(const Arguments& arguments);

/// Returns the text printed for an edit.
std::string describe(const EditResult& result);
/// Returns the summary of --json.
Json toJson(const EditOutcome& outcome);

}  // namespace urban_nav
