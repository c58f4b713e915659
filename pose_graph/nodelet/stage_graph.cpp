// SPDX-License-Identifier: BSD-3-Clause
#include "stage_graph.hpp"

#include <algorithm>
#include <utility>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/session.hpp"

namespace pose_graph {

using urban_nav_core::ClosureMethod;
using urban_nav_core::EdgeRef;
using urban_nav_core::PoseRef;
using urban_nav_core::PoseRun;
using urban_nav_core::UserError;

namespace {

// Closures that wait for odometry. It is seconds behind at most; more of them name poses that will never come.
constexpr std::size_t most_waiting = 1000;
// A stamp that lies this far back is a bag that began again or a clock that was set, not a late message.
constexpr StampNs back_in_time = 1'000'000'000;

PoseRef refOf(const NodeRef& node) { return {node.session, node.stamp}; }

EdgeRef refOf(const Closure& closure) {
  return {refOf(closure.a), refOf(closure.b), toString(closure.kind), closure.source};
}

EdgeKind kindOf(const std::string& word) {
  const auto kind = urban_nav_store::parseEdgeKind(word);
  if (!kind || *kind == EdgeKind::Odometry || *kind == EdgeKind::Session)
    throw UserError("kind", "`" + word + "`", "stereo, icp, plane, asserted");
  return *kind;
}

Tie::Look lookOf(const Closure& closure) {
  if (closure.verdict == ClosureVerdict::Waiting) return Tie::Look::Waiting;
  if (closure.verdict == ClosureVerdict::Rejected) return Tie::Look::Rejected;
  switch (closure.kind) {
    case EdgeKind::Icp: return Tie::Look::Icp;
    case EdgeKind::Plane: return Tie::Look::Plane;
    case EdgeKind::Asserted: return Tie::Look::Asserted;
    case EdgeKind::Session: return Tie::Look::Session;
    default: return Tie::Look::Stereo;
  }
}

std::size_t numberOf(const Track& track, StampNs stamp) {
  return static_cast<std::size_t>(std::lower_bound(track.stamps.begin(), track.stamps.end(), stamp) -
                                  track.stamps.begin());
}

}  // namespace

StageGraph::StageGraph(const Parameters& parameters, std::string robot, std::string recording)
    : parameters_(parameters), robot_(std::move(robot)), recording_(std::move(recording)), graph_(parameters) {}

void StageGraph::begin(const std::string& name, StampNs start) {
  SessionId id = urban_nav_store::sessionIdOf({robot_, name, start, ""});
  // A bag that is played again has the name and the start of the time before.
  for (int round = 2; graph_.hasSession(id); ++round)
    id = urban_nav_store::sessionIdOf({robot_, name + " (" + std::to_string(round) + ")", start, ""});
  graph_.beginSession(id);
  session_ = id;
  waiting_.clear();
  moved_.resize(graph_.tracks().size());
}

void StageGraph::add(const urban_nav_core::RelativePose& relative) {
  if (session_.empty() || relative.from < newest() - back_in_time) begin(recording_, relative.from);
  if (!graph_.addOdometry(session_, relative)) return;
  const auto& tracks = graph_.tracks();
  for (std::size_t i = 0; i < tracks.size(); ++i)
    if (tracks[i].session == session_) moved_[i].grow(tracks[i].stamps.size(), graph_.revision());
  offerWaiting();
}

void StageGraph::add(const urban_nav_core::MetricClosure& closure) {
  if (closure.verdict != urban_nav_core::ClosureVerdict::Accepted || closure.method == ClosureMethod::None) return;
  Closure offered;
  offered.a = nodeOf(closure.a);
  offered.b = nodeOf(closure.b);
  offered.kind = closure.method == ClosureMethod::Icp ? EdgeKind::Icp : EdgeKind::Stereo;
  offered.source = closure.source;
  offered.measured = closure.measured;
  offered.odometry_gate = closure.odometry_gate;
  offer(std::move(offered));
}

void StageGraph::add(const urban_nav_core::RelativeConstraint& constraint) {
  Closure offered;
  offered.a = nodeOf(constraint.a);
  offered.b = nodeOf(constraint.b);
  offered.kind = kindOf(constraint.kind);
  offered.source = constraint.source;
  offered.measured = constraint.measured;
  offer(std::move(offered));
}

NodeRef StageGraph::nodeOf(const PoseRef& ref) const {
  return {ref.session.empty() ? session_ : ref.session, ref.stamp};
}

bool StageGraph::isAhead(const NodeRef& node) const {
  return node.session.empty() || (node.session == session_ && node.stamp > newest());
}

void StageGraph::offer(Closure closure) {
  if (isAhead(closure.a) || isAhead(closure.b)) {
    if (waiting_.size() == most_waiting) waiting_.pop_front();
    waiting_.push_back(std::move(closure));
    return;
  }
  graph_.addClosure(closure);
  changed_ = true;
}

void StageGraph::offerWaiting() {
  std::deque<Closure> still;
  std::string refusal;
  for (Closure& closure : std::exchange(waiting_, {})) {
    // One that came before the first odometry of its session.
    if (closure.a.session.empty()) closure.a.session = session_;
    if (closure.b.session.empty()) closure.b.session = session_;
    if (isAhead(closure.a) || isAhead(closure.b)) {
      still.push_back(std::move(closure));
      continue;
    }
    try {
      graph_.addClosure(closure);
      changed_ = true;
    } catch (const UserError& error) {
      refusal = error.what();
    }
  }
  waiting_ = std::move(still);
  if (!refusal.empty()) throw UserError("", refusal, "");
}

LiveGraph::Outcome StageGraph::relax(bool batch) {
  if (!ready_.empty() && !batch) {
    Outcome outcome = std::move(ready_.front());
    ready_.pop_front();
    return outcome;
  }
  return absorb(batch ? graph_.relax() : graph_.update());
}

LiveGraph::Outcome StageGraph::absorb(const Relaxed& relaxed) {
  changed_ = false;
  Outcome outcome;
  urban_nav_core::GraphUpdate update;
  update.revision = relaxed.revision;
  update.previous = relaxed.revision - 1;
  for (const Relaxed::Run& run : relaxed.moved) {
    moved_[run.track].moved({run.first, run.last}, relaxed.revision);
    update.runs.push_back(runOf(graph_.tracks()[run.track], {run.first, run.last}));
  }
  if (!update.runs.empty()) outcome.update = std::move(update);
  if (relaxed.jump) {
    urban_nav_core::MapJump jump;
    jump.revision = relaxed.revision;
    jump.at = refOf(relaxed.jump->at);
    jump.T_map_base_before = relaxed.jump->before;
    jump.T_map_base_after = relaxed.jump->after;
    jump.sentence = relaxed.jump->reason;
    for (const ClosureId id : relaxed.jump->witnesses)
      if (const auto found = graph_.closures().find(id); found != graph_.closures().end())
        jump.witnesses.push_back(refOf(found->second));
    outcome.jumps.push_back(std::move(jump));
  }
  outcome.figures.revision = relaxed.revision;
  outcome.figures.sessions = static_cast<std::int64_t>(graph_.tracks().size());
  outcome.figures.sessions_joined = relaxed.sessions_joined;
  outcome.figures.poses = static_cast<std::int64_t>(relaxed.poses);
  outcome.figures.edges = static_cast<std::int64_t>(relaxed.edges);
  outcome.figures.closures = static_cast<std::int64_t>(relaxed.closures);
  outcome.figures.closures_rejected = static_cast<std::int64_t>(relaxed.rejected);
  outcome.figures.closures_waiting = static_cast<std::int64_t>(relaxed.waiting);
  outcome.figures.cost_before = relaxed.cost_before;
  outcome.figures.cost_after = relaxed.cost_after;
  outcome.status = graph_.status();
  outcome.reason_name = toString(static_cast<Trouble>(outcome.status.reason));
  return outcome;
}

StampNs StageGraph::newest() const {
  const Track* track = running();
  return track == nullptr || track->stamps.empty() ? 0 : track->stamps.back();
}

Pose StageGraph::T_map_odom() const {
  const Track* track = running();
  return track == nullptr || track->stamps.empty() ? Pose() : graph_.mapFromOdom(session_);
}

PoseRun StageGraph::runOf(const Track& track, const LastMoved::Range& range) const {
  PoseRun run;
  run.session = track.session;
  run.poses.reserve(range.second - range.first + 1);
  for (std::size_t i = range.first; i <= range.second; ++i) run.poses.push_back({track.stamps[i], track.map[i]});
  return run;
}

LiveGraph::Picture StageGraph::picture() const {
  Picture picture;
  for (const Track& track : graph_.tracks()) {
    if (track.stamps.empty() || track.session == session_) continue;
    picture.runs.push_back(runOf(track, {0, track.stamps.size() - 1}));
  }
  if (const Track* track = running(); track != nullptr && !track->stamps.empty())
    picture.runs.push_back(runOf(*track, {0, track->stamps.size() - 1}));
  const auto place = [this](const NodeRef& node) -> std::optional<Eigen::Vector3d> {
    const Track* track = graph_.track(node.session);
    if (track == nullptr) return std::nullopt;
    const std::size_t i = numberOf(*track, node.stamp);
    if (i >= track->stamps.size() || track->stamps[i] != node.stamp) return std::nullopt;
    return track->map[i].t();
  };
  for (const auto& [id, closure] : graph_.closures()) {
    const auto a = place(closure.a), b = place(closure.b);
    if (a && b) picture.ties.push_back({*a, *b, lookOf(closure)});
  }
  return picture;
}

LiveGraph::Trajectory StageGraph::trajectory(StampNs from, StampNs to, std::int64_t since) const {
  Trajectory trajectory;
  trajectory.revision = graph_.revision();
  for (std::size_t i = 0; i < graph_.tracks().size(); ++i) {
    const Track& track = graph_.tracks()[i];
    const std::size_t first = from > 0 ? numberOf(track, from) : 0;
    const std::size_t end = to > 0 ? numberOf(track, to + 1) : track.stamps.size();
    // Whoever knows nothing is told all, poses of the revision 0 included.
    for (const LastMoved::Range& range : moved_[i].since(since > 0 ? since : -1, first, end))
      trajectory.runs.push_back(runOf(track, range));
  }
  return trajectory;
}

LiveGraph::EdgeReply StageGraph::addEdge(const EdgeRef& edge, const urban_nav_core::Constraint& measured) {
  Closure offered;
  offered.a = nodeOf(edge.a);
  offered.b = nodeOf(edge.b);
  offered.kind = kindOf(edge.kind);
  offered.source = edge.source;
  offered.measured = measured;
  const ClosureId id = graph_.addClosure(offered);
  ready_.push_back(absorb(graph_.update()));
  const Closure& judged = graph_.closures().at(id);
  EdgeReply reply;
  reply.message = std::string(toString(judged.verdict)) + (judged.reason.empty() ? "" : ": " + judged.reason);
  for (const ClosureId other : judged.contradicted_by)
    if (const auto found = graph_.closures().find(other); found != graph_.closures().end())
      reply.contradicting.push_back(refOf(found->second));
  return reply;
}

LiveGraph::EdgeReply StageGraph::removeEdge(const EdgeRef& edge) {
  const NodeRef a = nodeOf(edge.a), b = nodeOf(edge.b);
  std::vector<ClosureId> meant;
  std::string between;
  for (const auto& [id, closure] : graph_.closures()) {
    if (!(closure.a == a && closure.b == b)) continue;
    between += (between.empty() ? "" : ", ") + std::string(toString(closure.kind)) + " of " + closure.source;
    const bool fits = (edge.kind.empty() || edge.kind == toString(closure.kind)) &&
                      (edge.source.empty() || edge.source == closure.source);
    if (fits) meant.push_back(id);
  }
  if (meant.size() != 1) {
    throw UserError("", meant.empty() ? "no such edge" : "more than one edge",
                    between.empty() ? "there is none between these poses, from a to b" : between);
  }
  graph_.removeClosure(meant.front());
  changed_ = true;
  return {"removed; the graph is relaxed without it", {}};
}

void StageGraph::save(const std::string&) { throw UserError("", "no store", ""); }
void StageGraph::load(const std::string&) { throw UserError("", "no store", ""); }

std::string StageGraph::newSession(const std::string& name) {
  if (session_.empty()) throw UserError("", "no session is being recorded: the first odometry begins one", "");
  begin(name.empty() ? recording_ : name, newest());
  return session_;
}

void StageGraph::reset() {
  graph_ = PoseGraph(parameters_);
  session_.clear();
  waiting_.clear();
  moved_.clear();
  ready_.clear();
  changed_ = false;
}

}  // namespace pose_graph
