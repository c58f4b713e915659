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
  /// Closures between two sessions, the first of which is the earlier one.
  struct Between {
    urban_nav_store::SessionId a, b;
    std::size_t candidates = 0, accepted = 0;
  };

  std::vector<Apart> apart;  ///< sessions without closures with other ones
  std::vector<Between> between;
  std::size_t candidates = 0, accepted_stereo = 0, accepted_icp = 0, rejected = 0;
  std::vector<std::string> warnings;
};

/// A join in progress: the sessions of all stores in a temporary store next to `out`, which is removed unless
/// published. Not thread-safe.
class Join {
 public:
  /// Throws UserError for stores that cannot be opened, DataError for damaged or unfinished ones and for sessions with
  /// different content in two stores.
  Join(JoinOptions options, AllStages stages, Console& console);

  /// Finds candidates for closures among the places of all sessions, in context().closures.
  void findCandidates();
  /// Measures the candidates that are not in context().measured, and relaxes all sessions.
  void relax();
  /// Moves the joined store to its path and returns the result. Ends the join.
  JoinRun publish();

  MapContext& context() { return *context_; }
  urban_nav_store::Store& store() { return *store_; }
  const std::vector<std::string>& warnings() const { return run_.warnings; }
  /// Adds a warning of a previous part of the join.
  void addWarning(const std::string& warning) { run_.warnings.push_back(warning); }

 private:
  const std::vector<std::string> sources_;
  Console& console_;
  const AllStages stages_;
  Workplace workplace_;
  MapOptions options_;
  std::unique_ptr<urban_nav_store::Store> store_;
  std::unique_ptr<MapContext> context_;
  ClosurePoses accepted_before_;  // in the source stores
  JoinRun run_;
};

/// Runs the stage of this name and adds its warnings to `warnings`. Skips a stage without input.
void runStage(const AllStages& stages, const std::string& name, MapContext& context,
              std::vector<std::string>& warnings);

/// Joins separately mapped sessions into one map: compares each place with all earlier ones, measures the candidates
/// from the data in the stores and relaxes all sessions together, as one run of `map` on all sessions in the order of
/// their start. Throws the errors of Join, without writing `out`.
JoinRun joinStores(JoinOptions options, AllStages stages, Console& console);

}  // namespace urban_nav
