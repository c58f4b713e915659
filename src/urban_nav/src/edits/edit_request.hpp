// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "base/command.hpp"
#include "edits/edited_map.hpp"
#include "topics/loops/stored_closure.hpp"

namespace urban_nav {

/// A person's request, checked against the content of the store.
struct EditRequest {
  std::string action;                ///< word on the command line
  urban_nav_store::StoredEdit edit;  ///< but for its number; not of undo and redo
  std::size_t count = 1;             ///< undo: how many
  std::string unchanged = {};        ///< why nothing would change; empty: something may
};

/// Returns the actions of `urban_nav edge` but `list`.
const std::vector<std::string>& editActions();

/// Reads an action and its arguments, and measures the pair of an action that does. Throws UserError naming what was
/// expected.
EditRequest readEditRequest(const Arguments& arguments, urban_nav_store::Store& store,
                            const StoredMeasurements& measurements);

}  // namespace urban_nav
