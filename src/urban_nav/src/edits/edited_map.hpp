// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "map/previous_sessions.hpp"
#include "topics/graph/graph_run.hpp"
#include "urban_nav_store/edit_journal.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// The content of a store that its map is relaxed from, but for edits.
struct StoredMeasurements {
  PreviousSessions sessions;
  PreviousClosures closures;
  SessionGrounds grounds;
  SessionFixes fixes;
  pose_graph::Parameters parameters;  ///< with which the store was relaxed
};
StoredMeasurements readMeasurements(urban_nav_store::Store& store);

/// Relaxes all sessions of a store as its measurements and edits have it, by the code of stage graph.
GraphRun relaxEdited(const StoredMeasurements& measurements, const std::vector<pose_graph::Edit>& edits);

/// Figures of a relaxed map that need no truth.
struct MapFigures {
  double cost = 0.0;  ///< of odometry and accepted closures, by their information as measured
  /// Root mean square of what remains of constraints from planes, over what their noise explains; nullopt: there are
  /// none.
  std::optional<double> planes_over_noise;
};
MapFigures readFigures(const GraphRun& run);

/// Returns by how much poses differ between the maps that a store holds and those of a relaxation.
struct PoseMoves {
  double largest = 0.0, rms = 0.0;  ///< m
  bool any = false;                 ///< one bit of a pose differs, or a verdict
};
using MapPoses = std::vector<urban_nav_core::Trajectory>;  ///< over all sessions
PoseMoves comparePoses(const MapPoses& before, const MapPoses& after);
MapPoses storedPoses(urban_nav_store::Store& store, const std::vector<urban_nav_store::SessionId>& ids);
MapPoses relaxedPoses(const GraphRun& run);

}  // namespace urban_nav
