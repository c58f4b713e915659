// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_store/store.hpp"

namespace pose_graph {

/// The measurements of a pose graph in a store, with edits applied. Relaxing them reproduces the same map, except for
/// origins set by edits.
struct StoredGraph {
  struct Chain {
    urban_nav_store::Session session;
    std::vector<urban_nav_core::RelativePose>
        steps;  ///< in order of time; a step that does not begin at the end of the previous one marks a gap
    std::vector<SpecificForce> forces;  ///< at poses of the session
    std::vector<GroundNormal> ground;   ///< at poses of the session
    std::vector<PositionFix> fixes;
  };
  std::vector<Chain> chains;      ///< in the order in which the sessions began
  std::vector<Closure> closures;  ///< in the order of their later pose; without verdicts
  std::int64_t revision = 0;      ///< highest revision of a stored pose
};

/// Reads the graph of a store. Closures without information, stored as evidence only, and closures of missing sessions
/// are left out. Throws DataError if the store is damaged.
StoredGraph readGraph(urban_nav_store::Store& store);

/// Formats the evidence that a stage reports for a closure as text lines for the store; passedOdometryGate() parses
/// them.
std::string toEvidence(const urban_nav_core::MetricClosure& closure);
std::string toEvidence(bool odometry_gate);
bool passedOdometryGate(const std::string& evidence);

/// Returns the parameters used for relaxation as rows of a session in the store.
std::vector<urban_nav_store::StoredParameter> listParameters(const Parameters& parameters);

/// Converts a closure to an edge of the store, without its verdict.
urban_nav_store::Edge toEdge(const Closure& closure);

}  // namespace pose_graph
