// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "topics/loops/stored_closure.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Returns the closures of a store that can be edited: all but constraints from planes, which are recomputed whenever
/// the map is rendered.
std::vector<StoredClosure> listEditableClosures(urban_nav_store::Store& store);

/// An entry of the journal of edits.
struct ListedEdit {
  std::int64_t number = 0;
  std::string command;  ///< action and arguments, quoted for a shell: "reject 3"
  bool undone = false;
  bool redoable = false;  ///< undone, and not dropped by an edit since
};
std::vector<ListedEdit> listEdits(urban_nav_store::Store& store);

/// Returns the closures of a store and its journal of edits, for `urban_nav edge STORE list`.
std::string listEdges(urban_nav_store::Store& store);
Json edgesAsJson(urban_nav_store::Store& store);

}  // namespace urban_nav
