// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edits/edit_request.hpp"

namespace urban_nav {

/// The effect of an edit on a map.
struct EditOutcome {
  bool changed = false;
  std::string reason;                ///< why nothing changed
  std::optional<std::int64_t> edit;  ///< number of the edit; after undo and redo: of the last one concerned
  std::optional<std::int64_t> edge;  ///< ID of a closure that was added
  PoseMoves moved;
  std::vector<std::int64_t> contradicted_by;  ///< IDs of closures that the edit contradicts
  MapFigures before, after;
  std::vector<std::string> warnings;
};

/// Makes an edit: enters it in the journal, relaxes the map and stores it, all in one transaction; nothing is rendered.
/// An edit that changes neither a pose nor a verdict is not entered. Throws the errors of the store, after which it is
/// as it was.
EditOutcome makeEdit(urban_nav_store::Store& store, const StoredMeasurements& measurements, const EditRequest& request);

}  // namespace urban_nav
