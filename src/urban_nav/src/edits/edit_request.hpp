// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "base/command.hpp"
#include "edits/edited_map.hpp"
#include "topics/loops/stored_closure.hpp"

namespace urban_nav {

/// A requested edit, checked against the content of the store.
struct EditRequest {
  std::string action;                ///< as on the command line
  urban_nav_store::StoredEdit edit;  ///< without its number; unused for undo and redo
  std::size_t count = 1;             ///< undo: number of edits
  std::string unchanged = {};        ///< reason why nothing would change; empty: it may
};

/// Returns the actions of `urban_nav edge` except `list`.
const std::vector<std::string>& editActions();

/// Reads an action and its arguments; for `measure`, measures the pair. Throws UserError.
EditRequest readEditRequest(const Arguments& arguments, urban_nav_store::Store& store,
                            const StoredMeasurements& measurements);

}  // namespace urban_nav
