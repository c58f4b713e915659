// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "live/live_graph.hpp"
#include "live/pose_revisions.hpp"
#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

/// Convert a node and a closure to references in outputs.
urban_nav_core::PoseRef toPoseRef(const NodeRef& node);
urban_nav_core::EdgeRef toEdgeRef(const Closure& closure);

/// Returns the index of the first pose of a track at or after a stamp.
std::size_t findPose(const Track& track, StampNs stamp);

/// Returns a range of a track's poses in the map.
urban_nav_core::TrajectorySegment toTrajectorySegment(const Track& track, const PoseRevisions::Range& range);

/// Converts the result of a relaxation; without status.
LiveGraph::Outcome toOutcome(const Relaxed& relaxed, const PoseGraph& graph);

/// Returns trajectories and closures for display. The trajectory of session `running` is last.
LiveGraph::Picture toPicture(const PoseGraph& graph, const SessionId& running);

/// Returns the poses from `from` to `to` (0: no bound) that moved since a revision (0: all). `revisions`: per track.
LiveGraph::Trajectory toTrajectory(const PoseGraph& graph, const std::vector<PoseRevisions>& revisions, StampNs from,
                                   StampNs to, std::int64_t since);

}  // namespace pose_graph
