// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "loop_metric/stored_surroundings.hpp"
#include "stages/vo/vo_stage.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// A session whose moments candidates may name.
struct LoopsSession {
  std::string name;  ///< as closures.csv has it
  urban_nav_store::SessionId id;
  const VoRun* run = nullptr;
};

/// What loop_metric has to know of sessions whose views and scans are in `store`. `camera` in words (camera_words.hpp): sessions of another one have no views.
loop_metric::StoredSurroundings::Sessions storedSessions(const std::vector<LoopsSession>& sessions,
                                                         urban_nav_store::Store& store, const std::string& camera);

}  // namespace urban_nav
