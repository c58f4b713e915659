// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_store/graph_store.hpp"
#include "urban_nav_store/table.hpp"

#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
/// Numbers of rows of a merge of stores.
struct MergeResult {
  std::int64_t rows = 0;       ///< in the merged store
  std::int64_t identical = 0;  ///< identical to a row of another source
  std::int64_t outdated = 0;   ///< poses and anchors of an older revision of the graph, omitted
};

/// Rows that a merge takes from the sources.
enum class MergeContent {
  All,
  /// Only rows of a single session: without poses in maps, the map, and closures that a joint relaxation of all
  /// sessions measures again (isFoundAnew).
  Sessions
};

/// Returns whether a joint relaxation of all sessions measures an edge again: a closure measured by a stage, or a
/// plane. Odometry, edges from files and asserted ones are not.
bool isFoundAnew(EdgeKind kind, const std::string& source);

/// Merges stores into one. Identical rows become one. A session in several files, as written by the computers of one
/// robot, becomes one session, complete if it is complete in every file. Parameters, and properties named run/... and
/// input/..., describe the run that wrote them: of different ones the lesser is kept. Different states of a stage
/// belong to different runs: none is kept. Edits of all sources are kept, and renumbered if two have the same number.
/// The result does not depend on the order of the sources, which are only read; `path` may be one of them. It is
/// written completely or not at all. Throws DataError that names and counts contradictory rows.
MergeResult merge(const std::vector<std::string>& sources, const std::string& path,
                  MergeContent content = MergeContent::All);

/// Selects rows by table and key, whose first column is the id of a session.
using RowFilter = std::function<bool(const Table& table, const std::vector<Value>& key)>;

/// Writes a new store with the rows of `source`, a store or a release, that `takes` selects. `path` must not exist.
/// Throws the errors of Store.
void copyRows(const std::string& source, const std::string& path, const RowFilter& takes);

}  // namespace urban_nav_store
