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

/// Stored inputs of the relaxation, without edits.
struct StoredMeasurements {
  PreviousSessions sessions;
  PreviousClosures closures;
  SessionGrounds grounds;
  SessionFixes fixes;
  pose_graph::Parameters parameters;  ///< of the relaxation of the store
};
StoredMeasurements readMeasurements(urban_nav_store::Store& store);

/// Relaxes all sessions of a store with its measurements and edits, by the code of stage graph.
GraphRun relaxEdited(const StoredMeasurements& measurements, const std::vector<pose_graph::Edit>& edits);

/// Figures of a relaxed map that do not require ground truth.
struct MapFigures {
  double cost = 0.0;  ///< of odometry and accepted closures, with their measured information
  /// Root mean square residual of the constraints from planes, divided by the value expected from their noise; nullopt
  /// without constraints.
  std::optional<double> planes_over_noise;
};
MapFigures readFigures(const GraphRun& run);

/// Differences between the poses of the stored maps and those of a relaxation.
struct PoseMoves {
  double largest = 0.0, rms = 0.0;  ///< m
  bool any = false;                 ///< any bit of a pose or any verdict differs
};
using MapPoses = std::vector<urban_nav_core::Trajectory>;  ///< over all sessions
PoseMoves comparePoses(const MapPoses& before, const MapPoses& after);
MapPoses storedPoses(urban_nav_store::Store& store, const std::vector<urban_nav_store::SessionId>& ids);
MapPoses relaxedPoses(const GraphRun& run);

}  // namespace urban_nav
