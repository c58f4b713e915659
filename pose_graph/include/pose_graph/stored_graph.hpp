// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_store/store.hpp"

namespace pose_graph {

/// What a store holds of a pose graph: the measurements as edits have it, from which relax() makes the same map again
/// (but for origins of edits).
struct StoredGraph {
  struct Chain {
    urban_nav_store::Session session;
    std::vector<urban_nav_core::RelativePose>
        steps;                          ///< in order of time; one that does not begin where the last ended: a gap
    std::vector<SpecificForce> forces;  ///< at its poses
    std::vector<GroundNormal> ground;   ///< at its poses
    std::vector<PositionFix> fixes;
  };
  std::vector<Chain> chains;      ///< in the order in which the sessions began
  std::vector<Closure> closures;  ///< in the order of the later of their two poses; as offered, not judged
  std::int64_t revision = 0;      ///< the highest that a pose in it is of
};

/// Reads it. Closures without any information are evidence alone and are left out; so are those of sessions that are
/// not there. DataError where the store is damaged.
StoredGraph readGraph(urban_nav_store::Store& store);

/// How a store keeps what a stage says of a closure: lines for a person, of which passedOdometryGate() finds its own
/// again.
std::string toEvidence(const urban_nav_core::MetricClosure& closure);
std::string toEvidence(bool odometry_gate);
bool passedOdometryGate(const std::string& evidence);

/// The rows of a session that say with which parameters it is relaxed.
std::vector<urban_nav_store::StoredParameter> listParameters(const Parameters& parameters);

/// The edge of the store that a closure is, but for its verdict.
urban_nav_store::Edge toEdge(const Closure& closure);

}  // namespace pose_graph
