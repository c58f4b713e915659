// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/console.hpp"
#include "base/parameter_set.hpp"
#include "join/workplace.hpp"
#include "map/context.hpp"
#include "map/lost_closures.hpp"
#include "map/stage_list.hpp"
#include "urban_nav_store/session.hpp"

namespace urban_nav {

struct JoinOptions {
  std::vector<std::string> stores;  ///< only read
  std::string out;                  ///< file to write; it appears when it is complete
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

/// A join in progress: the sessions of all stores in an unfinished store next to `out`, which vanishes unless it is
/// published. Not thread-safe.
class Join {
 public:
  /// Throws UserError for stores that cannot be opened, DataError for damaged or unfinished ones and for sessions that
  /// two stores hold with different content.
  Join(JoinOptions options, AllStages stages, Console& console);

  /// Finds the candidates for closures among the places of all sessions: closures of context().
  void findCandidates();
  /// Measures the candidates, but for those in context().measured, and relaxes all sessions.
  void relax();
  /// Gives the joined store its name, and returns what came of it. Ends the join.
  JoinRun publish();

  MapContext& context() { return *context_; }
  urban_nav_store::Store& store() { return *store_; }
  const std::vector<std::string>& warnings() const { return run_.warnings; }
  /// Adds one of an earlier part of the join.
  void addWarning(const std::string& warning) { run_.warnings.push_back(warning); }

 private:
  const std::vector<std::string> sources_;
  Console& console_;
  const AllStages stages_;
  Workplace workplace_;
  MapOptions options_;
  std::unique_ptr<urban_nav_store::Store> store_;
  std::unique_ptr<MapContext> context_;
  ClosurePoses accepted_before_;  // of the sources
  JoinRun run_;
};

/// Runs the stage of this name, and adds its warnings to `warnings`. One without input is left out.
void runStage(const AllStages& stages, const std::string& name, MapContext& context,
              std::vector<std::string>& warnings);

/// Makes one map of sessions that were mapped apart: each place of each session is compared with all earlier ones,
/// candidates are measured from what the stores hold, and all sessions are relaxed together, as if one run of `map` had
/// read them in the order of their start. Throws as Join does; nothing is then left at `out`.
JoinRun joinStores(JoinOptions options, AllStages stages, Console& console);

}  // namespace urban_nav
