// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "stages/graph/graph_stage.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Sessions that a store holds from earlier runs, as far as the graph stage needs them.
struct EarlierSessions {
  std::vector<urban_nav_store::SessionId> ids;
  std::vector<std::string> names;  ///< as closures.csv names them
  /// Chains of odometry with their numbers to the last bit, rows of dropped frames, forces, and the place of the camera; nothing else of a run.
  std::vector<VoRun> runs;
  std::int64_t revision = 0;  ///< the highest of their anchors
};

/// All but those in `without`, in the order of their beginnings. Errors as urban_nav_store has them.
EarlierSessions readEarlierSessions(urban_nav_store::Store& store,
                                    const std::vector<urban_nav_store::SessionId>& without);

/// What the store holds between these sessions, which are called by `names`; asserted ones too.
std::vector<KnownClosure> closuresBetween(urban_nav_store::Store& store,
                                          const std::vector<urban_nav_store::SessionId>& ids,
                                          const std::vector<std::string>& names);

/// Does it hold closures of any kind? Then its sessions have been relaxed, or can be.
bool holdsClosures(urban_nav_store::Store& store);

}  // namespace urban_nav
