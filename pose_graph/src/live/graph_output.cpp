// SPDX-License-Identifier: BSD-3-Clause
#include "live/graph_output.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>

namespace pose_graph {

using urban_nav_core::TrajectorySegment;

namespace {

ClosureMarker::Style toStyle(const Closure& closure) {
  using Style = ClosureMarker::Style;
  if (closure.verdict == ClosureVerdict::Waiting) return Style::Waiting;
  if (closure.verdict == ClosureVerdict::Rejected) return Style::Rejected;
  switch (closure.kind) {
    case EdgeKind::Icp: return Style::Icp;
    case EdgeKind::Plane: return Style::Plane;
    case EdgeKind::Asserted: return Style::Asserted;
    case EdgeKind::Session: return Style::Session;
    default: return Style::Stereo;
  }
}

std::optional<Eigen::Vector3d> findPosition(const PoseGraph& graph, const NodeRef& node) {
  const Track* track = graph.track(node.session);
  if (track == nullptr) return std::nullopt;
  const std::size_t i = findPose(*track, node.stamp);
  if (i >= track->stamps.size() || track->stamps[i] != node.stamp) return std::nullopt;
  return track->map[i].t();
}

urban_nav_core::PoseCorrection toPoseCorrection(const Relaxed& relaxed) {
  urban_nav_core::PoseCorrection correction;
  correction.revision = relaxed.revision;
  correction.at = toPoseRef(relaxed.correction->at);
  correction.T_map_base_before = relaxed.correction->before;
  correction.T_map_base_after = relaxed.correction->after;
  correction.reason = static_cast<int>(relaxed.correction->reason);
  correction.reason_name = toString(relaxed.correction->reason);
  correction.sentence = relaxed.correction->sentence;
  for (const Closure& edge : relaxed.correction->causing_edges) correction.causing_edges.push_back(toEdgeRef(edge));
  return correction;
}

}  // namespace

std::string toSentence(const Figures& figures) {
  std::ostringstream text;
  text << figures.poses << " poses, " << figures.closures << " closures, " << figures.closures_rejected << " rejected, "
       << figures.closures_waiting << " waiting; cost " << std::setprecision(5) << figures.cost_before << " -> "
       << figures.cost_after << " in " << std::setprecision(3) << figures.relax_ms << " ms";
  return text.str();
}

urban_nav_core::PoseRef toPoseRef(const NodeRef& node) { return {node.session, node.stamp}; }

urban_nav_core::EdgeRef toEdgeRef(const Closure& closure) {
  return {toPoseRef(closure.a), toPoseRef(closure.b), toString(closure.kind), closure.source};
}

std::size_t findPose(const Track& track, StampNs stamp) {
  return static_cast<std::size_t>(std::lower_bound(track.stamps.begin(), track.stamps.end(), stamp) -
                                  track.stamps.begin());
}

TrajectorySegment toTrajectorySegment(const Track& track, const PoseRevisions::Range& range) {
  TrajectorySegment run;
  run.session = track.session;
  run.poses.reserve(range.second - range.first + 1);
  for (std::size_t i = range.first; i <= range.second; ++i) run.poses.push_back({track.stamps[i], track.map[i]});
  return run;
}

LiveGraph::Outcome toOutcome(const Relaxed& relaxed, const PoseGraph& graph) {
  LiveGraph::Outcome outcome;
  urban_nav_core::GraphUpdate update;
  update.revision = relaxed.revision;
  update.previous = relaxed.revision - 1;
  for (const Relaxed::Run& run : relaxed.moved)
    update.segments.push_back(toTrajectorySegment(graph.tracks()[run.track], {run.first, run.last}));
  if (!update.segments.empty()) outcome.update = std::move(update);
  if (relaxed.correction) outcome.corrections.push_back(toPoseCorrection(relaxed));
  Figures& figures = outcome.figures;
  figures.revision = relaxed.revision;
  figures.sessions = static_cast<std::int64_t>(graph.tracks().size());
  figures.sessions_joined = relaxed.sessions_joined;
  figures.poses = static_cast<std::int64_t>(relaxed.poses);
  figures.edges = static_cast<std::int64_t>(relaxed.edges);
  figures.closures = static_cast<std::int64_t>(relaxed.closures);
  figures.closures_rejected = static_cast<std::int64_t>(relaxed.rejected);
  figures.closures_waiting = static_cast<std::int64_t>(relaxed.waiting);
  figures.cost_before = relaxed.cost_before;
  figures.cost_after = relaxed.cost_after;
  outcome.needs_batch = relaxed.needs_batch;
  return outcome;
}

LiveGraph::Picture toPicture(const PoseGraph& graph, const SessionId& running) {
  LiveGraph::Picture picture;
  const Track* last = nullptr;
  for (const Track& track : graph.tracks()) {
    if (track.stamps.empty()) continue;
    if (track.session == running) last = &track;
    else picture.segments.push_back(toTrajectorySegment(track, {0, track.stamps.size() - 1}));
  }
  if (last != nullptr) picture.segments.push_back(toTrajectorySegment(*last, {0, last->stamps.size() - 1}));
  for (const auto& [id, closure] : graph.closures()) {
    const auto a = findPosition(graph, closure.a), b = findPosition(graph, closure.b);
    if (a && b) picture.closures.push_back({*a, *b, toStyle(closure)});
  }
  return picture;
}

LiveGraph::Trajectory toTrajectory(const PoseGraph& graph, const std::vector<PoseRevisions>& revisions, StampNs from,
                                   StampNs to, std::int64_t since) {
  LiveGraph::Trajectory trajectory;
  trajectory.revision = graph.revision();
  for (std::size_t i = 0; i < graph.tracks().size(); ++i) {
    const Track& track = graph.tracks()[i];
    const std::size_t first = from > 0 ? findPose(track, from) : 0;
    const std::size_t end = to > 0 ? findPose(track, to + 1) : track.stamps.size();
    // Without a revision all poses are returned, including those of revision 0.
    for (const PoseRevisions::Range& range : revisions[i].movedSince(since > 0 ? since : -1, first, end))
      trajectory.segments.push_back(toTrajectorySegment(track, range));
  }
  return trajectory;
}

}  // namespace pose_graph
