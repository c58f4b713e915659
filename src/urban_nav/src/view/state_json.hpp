// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "edits/edge_list.hpp"
#include "urban_nav_store/stored_map.hpp"
#include "urban_nav_store/tables/stored_test.hpp"

namespace urban_nav {

/// The content of a store shown by the page. References must outlive it.
struct ShownState {
  const std::vector<std::vector<urban_nav_store::StoredTrajectory>>& maps;
  const std::vector<StoredClosure>& closures;
  const std::vector<ListedEdit>& edits;
  const std::vector<urban_nav_store::StoredTest>& tests;
  std::string store = {};
  std::int64_t revision = 0;
  bool read_only = false, written_by_another = false;
};

/// Returns the state as JSON: `sessions` in the order of their maps, `closures`, whose ends refer to a session by its
/// index in that list, `edits`, and the consistency `tests` of `trust`, whose intervals are s from the first pose of
/// their session. Stamps are texts in s since 1970, as for `edge`.
Json stateAsJson(const ShownState& state);

/// Appends a number as float32 in little endian.
void appendFloat32(std::string& bytes, double value);

/// Appends the poses of a session: seconds since the first one, x, y, z (m) as float32 in little endian.
void appendPath(std::string& bytes, const std::vector<urban_nav_core::StampedPose>& path);

}  // namespace urban_nav
