// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

struct MergeResult {
  std::int64_t rows = 0;       ///< in the merged store
  std::int64_t identical = 0;  ///< that a second file held as well
  std::int64_t outdated = 0;   ///< relaxed poses and anchors of an older revision of the graph, left out
};

/// One store out of several: rows that are identical become one. Rows that contradict each other are named, all
/// of them counted, and no file is made (DataError). The same session in several files, as the computers of one robot
/// write it, is one session, complete if it is in every file. The sources are only read; `path` appears whole, or not at
/// all, and may be one of them. The order of the sources does not matter. States of a stage in one session that are not the same are of different runs: none of them
/// stays.
MergeResult merge(const std::vector<std::string>& sources, const std::string& path);

}  // namespace urban_nav_store
