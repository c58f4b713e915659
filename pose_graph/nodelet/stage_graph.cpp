// SPDX-License-Identifier: BSD-3-Clause
#include "stage_graph.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "urban_nav_core/sequence/time_jump.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/session.hpp"

namespace pose_graph {

using urban_nav_core::EdgeRef;
using urban_nav_core::PoseRef;
using urban_nav_core::PoseRun;
using urban_nav_core::UserError;

namespace {

// Closures that wait for odometry. It is seconds behind at most; more of them name poses that will never come.
constexpr std::size_t most_waiting = 1000;
// A map is levelled at the earliest by three spans of 2 s (level.hpp); where that was not enough, when twice as much has been driven.
constexpr StampNs first_level = 6'500'000'000;
// What was felt comes into the graph at least so often, and from there into the store.
constexpr StampNs forces_every = 10'000'000'000;

PoseRef refOf(const NodeRef& node) { return {node.session, node.stamp}; }

EdgeRef refOf(const Closure& closure) {
  return {refOf(closure.a), refOf(closure.b), toString(closure.kind), closure.source};
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

class BatchWork : public LiveGraph::Work {
 public:
  BatchWork(Batch batch, int beginning) : batch_(std::move(batch)), beginning_(beginning) {}
  void run(const std::atomic<bool>& stop) override {
    SolveOptions options;
    options.progress = [&stop](int, double) { return !stop; };
    pose_graph::run(batch_, options);
  }
  const Batch& batch() const { return batch_; }
  int beginning() const { return beginning_; }

 private:
  Batch batch_;
  const int beginning_;
};

}  // namespace

StageGraph::StageGraph(const Parameters& parameters, std::string robot, std::string recording, const std::string& store)
    : parameters_(parameters),
      robot_(std::move(robot)),
      recording_(std::move(recording)),
      graph_(parameters),
      link_(store) {}

StageGraph::~StageGraph() {
  end();
  if (Keeper* keeper = link_.keeper()) keeper->handOver(graph_);
}

void StageGraph::begin(const std::string& name, StampNs start) {
  end();
  if (!session_.empty()) {
    waiting_.clear();
    session_ended_ = newest() > 0;
  }
  felt_.begin();
  began_ = start;
  level_at_ = start + first_level;
  forces_at_ = start + forces_every;
  if (goOn(name, start)) return;
  urban_nav_store::Session session;
  session.name = name.empty() ? urban_nav_core::printStamp(start) : name;
  session.robot = robot_;
  session.recording = name;
  session.start = start;
  session.id = urban_nav_store::sessionIdOf({robot_, name, start, ""});
  // A bag that is played again has the name and the start of the time before.
  for (int round = 2; sessions_.count(session.id) > 0; ++round) {
    session.recording = name + " (" + std::to_string(round) + ")";
    session.id = urban_nav_store::sessionIdOf({robot_, session.recording, start, ""});
  }
  graph_.beginSession(session.id);
  session_ = session.id;
  heard_ = start;
  announce(session);
  moved_.resize(graph_.tracks().size());
}

bool StageGraph::goOn(const std::string& name, StampNs start) {
  for (const SessionId& id : earlier_) {
    const urban_nav_store::Session& session = sessions_.at(id);
    const Track* track = graph_.track(id);
    if (track == nullptr || session.robot != robot_ || session.recording != name) continue;
    if (session.start != start && (track->stamps.empty() || track->stamps.back() != start)) continue;
    session_ = id;
    heard_ = start;
    graph_.goOn(id);
    announce(session);
    earlier_.erase(id);
    return true;
  }
  return false;
}

void StageGraph::announce(const urban_nav_store::Session& session) {
  urban_nav_store::Session now = session;
  now.complete = false;
  sessions_[now.id] = now;
  if (Keeper* keeper = link_.keeper()) keeper->put(now, parametersOf(parameters_));
}

void StageGraph::end() {
  if (session_.empty()) return;
  urban_nav_store::Session& session = sessions_.at(session_);
  session.complete = true;
  if (Keeper* keeper = link_.keeper()) keeper->put(session);
}

void StageGraph::add(const urban_nav_core::RelativePose& relative) {
  if (session_.empty() || urban_nav_core::jumpsBack(relative.from, heard_)) begin(recording_, relative.from);
  heard_ = std::max(heard_, relative.to);
  if (!graph_.addOdometry(session_, relative)) return;
  const auto& tracks = graph_.tracks();
  for (std::size_t i = 0; i < tracks.size(); ++i)
    if (tracks[i].session == session_) moved_[i].grow(tracks[i].stamps.size(), graph_.revision());
  tie();
  if (relative.to >= forces_at_) putForces();
  if (relative.to >= level_at_) level();
  offerWaiting();
}

void StageGraph::add(const urban_nav_core::StampedPose& odometry) {
  tie_.hear(odometry);
  tie();
}

void StageGraph::putForces() {
  forces_at_ = newest() + forces_every;
  if (const Track* track = running()) graph_.putForces(session_, felt_.at(track->stamps));
}

void StageGraph::level() {
  level_at_ = began_ + 2 * (newest() - began_);
  if (graph_.isLevel(session_)) return;
  putForces();
  if (const auto levelled = graph_.level()) ready_.push_back(absorb(*levelled));
}

void StageGraph::add(const urban_nav_core::MetricClosure& closure) { offer(offeredOf(closure)); }

void StageGraph::add(const urban_nav_core::RelativeConstraint& constraint) { offer(offeredOf(constraint)); }

NodeRef StageGraph::nodeOf(const PoseRef& ref) const {
  return {ref.session.empty() ? session_ : ref.session, ref.stamp};
}

bool StageGraph::isAhead(const NodeRef& node) const {
  return node.session.empty() || (node.session == session_ && node.stamp > newest());
}

bool StageGraph::isAhead(const Offered& offered) const {
  return isAhead(offered.closure.a) || isAhead(offered.closure.b);
}

void StageGraph::nameSessions(Offered& offered) const {
  if (offered.closure.a.session.empty()) offered.closure.a.session = session_;
  if (offered.closure.b.session.empty()) offered.closure.b.session = session_;
}

void StageGraph::offer(Offered offered) {
  nameSessions(offered);
  if (isAhead(offered)) {
    if (waiting_.size() == most_waiting) waiting_.pop_front();
    waiting_.push_back(std::move(offered));
    return;
  }
  take(offered);
}

void StageGraph::take(Offered& offered) {
  Keeper* keeper = link_.keeper();
  if (offered.rejected) {
    if (keeper == nullptr) return;
    urban_nav_store::Edge edge = edgeOf(offered.closure);
    edge.measured.information.setZero();  // says nothing, and is no part of the graph that is read again
    edge.verdict = ClosureVerdict::Rejected;
    edge.weight = 0.0;
    keeper->putRejected(edge, offered.evidence);
    return;
  }
  graph_.addClosure(offered.closure);
  if (keeper != nullptr && !offered.evidence.empty()) keeper->putEvidence(edgeOf(offered.closure), offered.evidence);
  changed_ = true;
}

void StageGraph::offerWaiting() {
  std::deque<Offered> still;
  std::string refusal;
  for (Offered& offered : std::exchange(waiting_, {})) {
    nameSessions(offered);  // of one that came before the first odometry of its session
    if (isAhead(offered)) {
      still.push_back(std::move(offered));
      continue;
    }
    try {
      take(offered);
    } catch (const UserError& error) {
      refusal = error.what();
    }
  }
  waiting_ = std::move(still);
  if (!refusal.empty()) throw UserError("", refusal, "");
}

LiveGraph::Outcome StageGraph::relax() {
  if (!ready_.empty()) {
    Outcome outcome = std::move(ready_.front());
    ready_.pop_front();
    return outcome;
  }
  changed_ = exactly_ = false;
  return absorb(graph_.update());
}

std::unique_ptr<LiveGraph::Work> StageGraph::batch() {
  batch_due_ = session_ended_ = false;
  putForces();
  return std::make_unique<BatchWork>(graph_.batch(), beginnings_);
}

std::optional<LiveGraph::Outcome> StageGraph::take(const Work& work) {
  const auto& done = dynamic_cast<const BatchWork&>(work);
  // Where another batch is due that an update would not do for, this one would only be corrected at once.
  if (done.beginning() != beginnings_ || batch_due_) return std::nullopt;
  putForces();
  changed_ = false;
  exactly_ = true;
  return absorb(graph_.take(done.batch()));
}

void StageGraph::keep() {
  if (const auto stored = link_.open()) {
    for (const auto& [id, session] : sessions_) link_.keeper()->put(session, parametersOf(parameters_));
    takeIn(*stored, true);
  }
  if (Keeper* keeper = link_.keeper()) keeper->follow(graph_, exactly_);
}

std::string StageGraph::load(const StoredGraph& stored) {
  const TakenIn taken = takeIn(stored, false);
  return std::to_string(taken.sessions) + " sessions with " + std::to_string(taken.poses) + " poses and " +
         std::to_string(taken.closures) + " closures are in the graph" +
         (taken.refused > 0 ? "; " + std::to_string(taken.refused) + " closures were refused" : "") +
         (taken.known > 0 ? "; " + std::to_string(taken.known) + " sessions were there already" : "");
}

StageGraph::TakenIn StageGraph::takeIn(const StoredGraph& stored, bool own) {
  TakenIn taken;
  Keeper* keeper = link_.keeper();
  for (const StoredGraph::Chain& chain : stored.chains) {
    const SessionId& id = chain.session.id;
    if (graph_.hasSession(id)) {
      ++taken.known;
      continue;
    }
    graph_.beginSession(id);
    for (const urban_nav_core::RelativePose& step : chain.steps) graph_.addOdometry(id, step);
    graph_.putForces(id, chain.forces);
    const std::size_t track = graph_.tracks().size() - 1, poses = graph_.tracks().back().stamps.size();
    sessions_[id] = chain.session;
    if (own) earlier_.insert(id);
    if (own) keeper->knows(graph_, track);
    else if (keeper != nullptr) keeper->put(chain.session);
    moved_.resize(track + 1);
    moved_.back().grow(poses, graph_.revision());
    ++taken.sessions;
    taken.poses += poses;
  }
  for (const Closure& closure : stored.closures) {
    try {
      if (graph_.findClosure(closure.a, closure.b, closure.kind, closure.source)) continue;
      const ClosureId id = graph_.addClosure(closure);
      if (own) keeper->knows(graph_.closures().at(id));
      else if (keeper != nullptr && closure.odometry_gate) keeper->putEvidence(edgeOf(closure), evidenceOf(true));
      ++taken.closures;
    } catch (const UserError&) {
      ++taken.refused;
    }
  }
  if (!session_.empty()) graph_.goOn(session_);
  if (taken.poses > 0) changed_ = batch_due_ = true;
  return taken;
}

urban_nav_core::Status StageGraph::status() const {
  const std::string fault = link_.state().fault;
  if (fault.empty()) return graph_.status();
  return {urban_nav_core::Health::Degraded, static_cast<int>(Trouble::NotStored), "nothing is stored: " + fault};
}

LiveGraph::Outcome StageGraph::absorb(const Relaxed& relaxed) {
  tie();
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
    jump.reason = static_cast<int>(relaxed.jump->reason);
    jump.reason_name = toString(relaxed.jump->reason);
    jump.sentence = relaxed.jump->sentence;
    for (const Closure& witness : relaxed.jump->witnesses) jump.witnesses.push_back(refOf(witness));
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
  outcome.needs_batch = relaxed.needs_batch;
  outcome.status = status();
  outcome.reason_name = toString(static_cast<Trouble>(outcome.status.reason));
  return outcome;
}

StampNs StageGraph::newest() const {
  const Track* track = running();
  return track == nullptr || track->stamps.empty() ? 0 : track->stamps.back();
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
  changed_ = false;
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
  changed_ = batch_due_ = true;  // what it has bent must come back to where the measurements alone would have it
  return {"removed; the graph is relaxed without it", {}};
}

LiveGraph::Rest StageGraph::save(const std::string& path) {
  if (Keeper* keeper = link_.keeper()) {
    keeper->handOver(graph_);
    return [writer = keeper->writer(), own = link_.path(), path]() -> std::string {
      writer->flush();
      if (const std::string fault = writer->counts().fault; !fault.empty()) throw UserError("", fault, "");
      std::error_code error;
      if (std::filesystem::equivalent(own, path, error)) return "all of it is committed";
      copyStore(own, path);
      return "copied from " + own;
    };
  }
  // Of a graph that is kept nowhere, a copy becomes a store.
  return [graph = graph_, sessions = sessions_, path] { return writeStore(graph, sessions, path); };
}

std::string StageGraph::newSession(const std::string& name) {
  if (session_.empty()) throw UserError("", "no session is being recorded: the first odometry begins one", "");
  begin(name.empty() ? recording_ : name, newest());
  return session_;
}

void StageGraph::reset() {
  end();
  if (Keeper* keeper = link_.keeper()) {
    keeper->handOver(graph_);
    keeper->forget();
  }
  graph_ = PoseGraph(parameters_, graph_.revision() + 1);  // nobody must take it for the one before
  session_.clear();
  heard_ = 0;
  if (link_.keeper() == nullptr) sessions_.clear();
  earlier_.clear();
  waiting_.clear();
  moved_.clear();
  ready_.clear();
  changed_ = batch_due_ = session_ended_ = false;
  ++beginnings_;
  tie_.forgetSessions();
  tie();
}

}  // namespace pose_graph
