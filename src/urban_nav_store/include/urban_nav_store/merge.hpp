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

struct MergeResult {
  std::int64_t rows = 0;       ///< in the merged store
  std::int64_t identical = 0;  ///< to rows of another source
  std::int64_t outdated = 0;   ///< poses and anchors of an older revision of the graph, left out
};

/// The rows of the sources that a merge takes.
enum class MergeContent {
  All,
  /// Only those that belong to each session alone: without poses in maps, the map, and closures that a relaxation of
  /// all sessions together finds anew (isFoundAnew).
  Sessions
};

/// Returns whether an edge is one that a relaxation of all sessions together finds anew: a closure that a stage has
/// measured, or a plane. Odometry, edges of a file and asserted ones are not.
bool isFoundAnew(EdgeKind kind, const std::string& source);

/// Merges stores into one. Identical rows become one. A session in several files, as written by the computers of one
/// robot, becomes one session, complete if it is complete in every file. Parameters, and properties named run/... and
/// input/..., describe the run that wrote them: of different ones the lesser stays. States of a stage that differ
/// belong to different runs: none is kept. Edits of all sources are kept; they are numbered anew if two have one
/// number. The result does not depend on the order of the sources, which are only read; `path` may be one of them. It
/// is written completely or not at all. Throws DataError that names and counts the rows that contradict each other.
MergeResult merge(const std::vector<std::string>& sources, const std::string& path,
                  MergeContent content = MergeContent::All);

/// Decides by its table and its key, which begins with the id of a session, whether a row is taken.
using RowFilter = std::function<bool(const Table& table, const std::vector<Value>& key)>;

/// Writes a new store with those rows of `source`, a store or a release, that `takes` admits. `path` must not be there.
/// Throws the errors of Store.
void copyRows(const std::string& source, const std::string& path, const RowFilter& takes);

}  // namespace urban_nav_store
