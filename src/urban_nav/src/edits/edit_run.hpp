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
  std::string reason;                ///< reason if nothing changed
  std::optional<std::int64_t> edit;  ///< number of the edit; after undo and redo: of the last one affected
  std::optional<std::int64_t> edge;  ///< ID of an added closure
  PoseMoves moved;
  std::vector<std::int64_t> contradicted_by;  ///< IDs of closures that the edit contradicts
  MapFigures before, after;
  std::vector<std::string> warnings;
};

/// Applies an edit: adds it to the journal, relaxes the map and stores it, in one transaction, without rendering. An
/// edit that changes neither a pose nor a verdict is not added. Throws the errors of the store, which is then
/// unchanged.
EditOutcome makeEdit(urban_nav_store::Store& store, const StoredMeasurements& measurements, const EditRequest& request);

}  // namespace urban_nav
