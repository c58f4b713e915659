// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace pose_graph {

/// Verdicts of a graph on measured closures, for the stage that proposed them. Not thread-safe.
class VerdictChanges {
 public:
  /// Returns the stereo and ICP closures that the graph has accepted or rejected since the last call, in order of their
  /// ids. Their source is "pose_graph"; the information of rejected ones is zero.
  std::vector<urban_nav_core::MetricClosure> take(const PoseGraph& graph);
  /// Forgets all verdicts; call when the graph is replaced.
  void clear() { known_.clear(); }

 private:
  std::map<ClosureId, ClosureVerdict> known_;
};

}  // namespace pose_graph
