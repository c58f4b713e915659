// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph_store_writer.hpp"

#include <algorithm>
#include <utility>

#include "pose_graph/ground_views.hpp"
#include "pose_graph/stored_graph.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_store/forces_state.hpp"
#include "urban_nav_store/stored_fixes.hpp"

namespace pose_graph {

using urban_nav_core::Matrix6d;
using urban_nav_core::RelativePose;
using urban_nav_store::Anchor;
using urban_nav_store::LiveWriter;
using urban_nav_store::Node;
using urban_nav_store::RelaxedPose;
using urban_nav_store::Store;

namespace {

// Limit of writes that wait for the disk; with kNodesAtOnce and about 1.2 kB per node at most 24 MB. In normal
// operation a second brings about fifty.
constexpr std::size_t kWaiting = 100;
constexpr std::size_t kNodesAtOnce = 200;
constexpr std::size_t kPending = 1000;  // limit of rejected closures and evidence texts
constexpr double kStoredDistance = 0.01, kStoredAngle = 0.02 * 3.14159265358979323846 / 180.0;  // docs/architecture.md

bool isSame(const Pose& a, const Pose& b) { return a.t() == b.t() && a.q().coeffs() == b.q().coeffs(); }

bool isSame(const GraphStoreWriter::StoredEdge& a, const GraphStoreWriter::StoredEdge& b) {
  return a.weight == b.weight && a.verdict == b.verdict && a.reason == b.reason &&
         isSame(a.measured.T_a_b, b.measured.T_a_b) && a.measured.information == b.measured.information;
}

GraphStoreWriter::StoredEdge stepEdge(const SessionId& session, const RelativePose& step) {
  GraphStoreWriter::StoredEdge edge;
  edge.a = {session, step.from};
  edge.b = {session, step.to};
  edge.kind = EdgeKind::Odometry;
  edge.source = step.source;
  edge.measured.T_a_b = step.T_from_to;
  edge.measured.information = urban_nav_core::invertPositiveDefinite(step.covariance).value_or(Matrix6d::Zero());
  return edge;
}

/// Nodes of a track with the steps that end at them.
struct Nodes {
  SessionId session;
  std::vector<Node> nodes;
  std::vector<GraphStoreWriter::StoredEdge> steps;

  void operator()(Store& store) const {
    for (const Node& node : nodes) store.graph().put(session, node);
    for (const GraphStoreWriter::StoredEdge& step : steps) store.graph().put(step);
  }
};

Nodes collectNodes(const PoseGraph& graph, std::size_t t, std::size_t first, std::size_t end) {
  const Track& track = graph.tracks()[t];
  Nodes made;
  made.session = track.session;
  for (std::size_t i = first; i < end; ++i) {
    Node node;
    node.stamp = track.stamps[i];
    node.T_odom_base = track.odom[i];
    if (const RelativePose* step = graph.stepTo(t, i)) {
      node.covariance = step->covariance;
      node.drift_covariance = step->drift_covariance;
      node.constants = step->constants;
      node.status = step->status.health;
      made.steps.push_back(stepEdge(track.session, *step));
    }
    made.nodes.push_back(node);
  }
  return made;
}

ClosureId findNewest(const PoseGraph& graph) { return graph.closures().empty() ? 0 : graph.closures().rbegin()->first; }

/// Returns the session whose first pose is the origin of a track's map.
const SessionId& findMap(const PoseGraph& graph, const Track& track) {
  for (const Track& other : graph.tracks())
    if (!other.part.empty() && other.part.front() == track.part.front()) return other.session;
  return track.session;
}

}  // namespace

/// All changes of the store by one relaxation, in one write.
struct GraphStoreWriter::Batch {
  std::vector<std::pair<SessionId, RelaxedPose>> poses;
  std::vector<Anchor> anchors;
  std::vector<StoredEdge> closures, removed;

  void operator()(Store& store) const {
    for (const auto& [session, pose] : poses) store.graph().put(session, pose);
    for (const Anchor& anchor : anchors) store.sessions().put(anchor);
    for (const StoredEdge& edge : removed) store.graph().remove(edge);
    for (const StoredEdge& edge : closures) store.graph().put(edge);
  }
};

LiveWriter::Options GraphStoreWriter::writerOptions(std::chrono::milliseconds period) {
  LiveWriter::Options options;
  options.capacity = kWaiting;
  options.period = period;
  return options;
}

GraphStoreWriter::GraphStoreWriter(std::shared_ptr<LiveWriter> writer, std::int64_t revision)
    : writer_(std::move(writer)), revision_(revision) {}

bool GraphStoreWriter::post(Write write) {
  if (writer_->counts().waiting >= kWaiting || !writer_->post(std::move(write))) return false;
  ++posted_;
  return true;
}

void GraphStoreWriter::postLater(Write write) { pending_.push_back(std::move(write)); }

void GraphStoreWriter::put(const urban_nav_store::Session& session,
                           const std::vector<urban_nav_store::StoredParameter>& parameters) {
  postLater([session, parameters](Store& store) {
    store.sessions().put(session);
    for (const auto& parameter : parameters) store.sessions().put(session.id, parameter);
  });
}

void GraphStoreWriter::putEvidence(const StoredEdge& edge, const std::string& evidence) {
  if (pending_.size() >= kPending) {
    ++lost_;
    return;
  }
  postLater([edge, evidence](Store& store) { store.graph().putEvidence(edge, evidence); });
}

void GraphStoreWriter::putRejected(const StoredEdge& edge, const std::string& evidence) {
  if (pending_.size() >= kPending) {
    ++lost_;
    return;
  }
  postLater([edge, evidence](Store& store) {
    store.graph().put(edge);
    store.graph().putEvidence(edge, evidence);
  });
}

void GraphStoreWriter::markStored(const PoseGraph& graph, std::size_t track) {
  if (tracks_.size() <= track) tracks_.resize(track + 1);
  tracks_[track].nodes = graph.tracks()[track].stamps.size();
  tracks_[track].forces = graph.forces(track).size();
  tracks_[track].ground = graph.ground(track).size();
  tracks_[track].fixes = graph.fixes(track).size();
}

void GraphStoreWriter::markStored(const Closure& closure) {
  closures_[closure.id] = toEdge(closure);
  closures_[closure.id].weight = -1.0;  // differs from any weight: written again with its verdict
}

void GraphStoreWriter::reset() {
  newest_closure_ = 0;
  tracks_.clear();
  closures_.clear();
}

void GraphStoreWriter::sync(const PoseGraph& graph, bool exactly) {
  tracks_.resize(graph.tracks().size());
  if (syncPending() && syncNodes(graph) && syncForces(graph, false) && syncGround(graph) && syncFixes(graph))
    syncRelaxation(graph, exactly, false);
}

void GraphStoreWriter::flush(const PoseGraph& graph) {
  tracks_.resize(graph.tracks().size());
  if (syncPending() && syncNodes(graph) && syncForces(graph, true) && syncGround(graph) && syncFixes(graph))
    syncRelaxation(graph, true, true);
}

bool GraphStoreWriter::syncPending() {
  while (!pending_.empty()) {
    if (!post(pending_.front())) return false;
    pending_.pop_front();
  }
  return true;
}

bool GraphStoreWriter::syncNodes(const PoseGraph& graph) {
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const std::size_t size = graph.tracks()[t].stamps.size();
    while (tracks_[t].nodes < size) {
      const std::size_t end = std::min(size, tracks_[t].nodes + kNodesAtOnce);
      if (!post(collectNodes(graph, t, tracks_[t].nodes, end))) return false;
      tracks_[t].nodes = end;
    }
  }
  return true;
}

// The forces of a session are stored as one value: rewritten after growing by a fifth, so that a byte is written about
// five times.
bool GraphStoreWriter::syncForces(const PoseGraph& graph, bool at_once) {
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const std::vector<SpecificForce>& forces = graph.forces(t);
    const std::size_t known = tracks_[t].forces;
    if (forces.size() <= known || (!at_once && 5 * forces.size() < 6 * known)) continue;
    const SessionId& session = graph.tracks()[t].session;
    if (!post([session, forces](Store& store) {
          store.states().put(session, urban_nav_store::kForcesStage, urban_nav_store::packForces(forces));
        }))
      return false;
    tracks_[t].forces = forces.size();
  }
  return true;
}

bool GraphStoreWriter::syncGround(const PoseGraph& graph) {
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const std::vector<GroundNormal>& ground = graph.ground(t);
    if (ground.size() <= tracks_[t].ground) continue;
    const SessionId& session = graph.tracks()[t].session;
    std::vector<GroundNormal> added(ground.begin() + static_cast<std::ptrdiff_t>(tracks_[t].ground), ground.end());
    if (!post([session, added](Store& store) { writeGround(store, session, added); })) return false;
    tracks_[t].ground = ground.size();
  }
  return true;
}

bool GraphStoreWriter::syncFixes(const PoseGraph& graph) {
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const std::vector<PositionFix>& fixes = graph.fixes(t);
    if (fixes.size() <= tracks_[t].fixes) continue;
    const SessionId& session = graph.tracks()[t].session;
    std::vector<PositionFix> added(fixes.begin() + static_cast<std::ptrdiff_t>(tracks_[t].fixes), fixes.end());
    if (!post([session, added](Store& store) { urban_nav_store::writeFixes(store, session, added); })) return false;
    tracks_[t].fixes = fixes.size();
  }
  return true;
}

void GraphStoreWriter::syncRelaxation(const PoseGraph& graph, bool exactly, bool at_once) {
  const ClosureId newest = findNewest(graph);
  const bool poses = graph.revision() != synced_revision_ || (exactly && !exact_);
  if (!poses && newest == newest_closure_) return;
  // One relaxation at a time: while the disk is slow, successive ones are combined in one write.
  const LiveWriter::Counts counts = writer_->counts();
  if ((!at_once && counts.committed + counts.refused < relaxation_) || counts.waiting >= kWaiting) return;
  auto batch = std::make_shared<Batch>();
  if (poses) {
    collectPoses(graph, exactly, *batch);
    exact_ = exactly;
  }
  collectClosures(graph, *batch);
  post([batch](Store& store) { (*batch)(store); });
  relaxation_ = posted_;
  synced_revision_ = graph.revision();
  newest_closure_ = newest;
}

void GraphStoreWriter::collectPoses(const PoseGraph& graph, bool exactly, Batch& batch) {
  const std::int64_t revision = revision_ + graph.revision();
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const Track& track = graph.tracks()[t];
    if (track.stamps.empty()) continue;
    std::vector<Pose>& stored = tracks_[t].map;
    const SessionId& map = findMap(graph, track);
    const bool as_odometry = stored.empty() && map == track.session &&
                             std::equal(track.map.begin(), track.map.end(), track.odom.begin(),
                                        [](const Pose& a, const Pose& b) { return isSame(a, b); });
    if (as_odometry) continue;
    for (std::size_t i = 0; i < track.map.size(); ++i) {
      const Pose& now = track.map[i];
      const bool moved = i >= stored.size() || (exactly ? !isSame(now, stored[i])
                                                        : distanceBetween(now, stored[i]) > kStoredDistance ||
                                                              angleBetween(now, stored[i]) > kStoredAngle);
      if (!moved) continue;
      batch.poses.push_back({track.session, {track.stamps[i], now, revision}});
      if (i < stored.size()) stored[i] = now;
      else stored.push_back(now);
    }
    batch.anchors.push_back({track.session, map, revision, track.map.front() * track.odom.front().inverse()});
  }
}

void GraphStoreWriter::collectClosures(const PoseGraph& graph, Batch& batch) {
  for (const auto& [id, closure] : graph.closures()) {
    const StoredEdge edge = toEdge(closure);
    const auto known = closures_.find(id);
    if (known != closures_.end() && isSame(known->second, edge)) continue;
    closures_[id] = edge;
    batch.closures.push_back(edge);
  }
  for (auto known = closures_.begin(); known != closures_.end();) {
    if (graph.closures().count(known->first) > 0) {
      ++known;
    } else {
      batch.removed.push_back(known->second);
      known = closures_.erase(known);
    }
  }
}

bool GraphStoreWriter::isUpToDate(const PoseGraph& graph) const {
  if (!pending_.empty() || synced_revision_ != graph.revision() || tracks_.size() != graph.tracks().size())
    return false;
  if (newest_closure_ != findNewest(graph)) return false;
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    if (tracks_[t].nodes != graph.tracks()[t].stamps.size()) return false;
  return writer_->counts().waiting == 0;
}

}  // namespace pose_graph
