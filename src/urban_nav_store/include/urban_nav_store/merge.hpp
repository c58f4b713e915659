// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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
  /// Only those that belong to each session alone: without poses in maps, closures and the map, which a relaxation of
  /// all sessions together computes anew. Asserted edges stay.
  Sessions
};

/// Merges stores into one. Identical rows become one. A session in several files, as written by the computers of one
/// robot, becomes one session, complete if it is complete in every file. Properties named run/... and input/...
/// describe the run that wrote them: of different ones the lesser stays. States of a stage that differ belong to
/// different runs: none is kept. The result does not depend on the order of the sources, which are only read; `path`
/// may be one of them. It is written completely or not at all. Throws DataError that names and counts the rows that
/// contradict each other.
MergeResult merge(const std::vector<std::string>& sources, const std::string& path,
                  MergeContent content = MergeContent::All);

}  // namespace urban_nav_store
