// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/console.hpp"
#include "base/parameter_set.hpp"
#include "map/stage_list.hpp"
#include "urban_nav_store/session.hpp"

namespace urban_nav {

struct JoinOptions {
  std::vector<std::string> stores;  ///< only read
  std::string out;                  ///< store to write; it appears when it is complete
  ParameterSet parameters;
  int threads = 0;  ///< 0: one per core
};

/// Closures between the sessions of joined stores.
struct JoinRun {
  struct Apart {
    urban_nav_store::SessionId session;
    std::string reason;
  };
  /// Closures between two sessions, the earlier one first.
  struct Between {
    urban_nav_store::SessionId a, b;
    std::size_t candidates = 0, accepted = 0;
  };

  std::vector<Apart> apart;  ///< sessions that no closure joins to another one
  std::vector<Between> between;
  std::size_t candidates = 0, accepted_stereo = 0, accepted_icp = 0, rejected = 0;
  std::vector<std::string> warnings;
};

/// Makes one map of sessions that were mapped apart: each place of each session is compared with all earlier ones,
/// candidates are measured from what the stores hold, and all sessions are relaxed together, as if one run of `map` had
/// read them in the order of their start. Throws UserError for stores that cannot be opened, DataError for damaged or
/// unfinished ones and for sessions that two stores hold with different content; nothing is then left at `out`.
JoinRun joinStores(JoinOptions options, AllStages stages, Console& console);

}  // namespace urban_nav
