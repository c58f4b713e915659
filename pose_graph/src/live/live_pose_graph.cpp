// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_pose_graph.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "live/graph_copy.hpp"
#include "live/graph_output.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/session.hpp"

namespace pose_graph {

using urban_nav_core::EdgeRef;
using urban_nav_core::PoseRef;
using urban_nav_core::UserError;

namespace {

// Limit of held closures. Odometry lags closures by seconds at most; more of them refer to poses that do not exist.
constexpr std::size_t kMaxHeld = 1000;
// Earliest time to align a map with gravity: three intervals of 2 s (level.hpp). Each further attempt waits until the
// drive is twice as long.
constexpr StampNs kFirstLevel = 6'500'000'000;
// Maximum delay until specific forces and ground normals reach the graph and the store.
constexpr StampNs kForcesPeriod = 10'000'000'000;

// Period of batches due to position fixes: odometry drifts less than the error of a fix within it.
constexpr StampNs kFixesPeriod = 30'000'000'000;

constexpr std::size_t kMostEarlyFixes = 1000;

class LiveBatch : public LiveGraph::Batch {
 public:
  LiveBatch(pose_graph::Batch batch, int generation) : batch_(std::move(batch)), generation_(generation) {}
  void run(const std::atomic<bool>& stop) override {
    SolveOptions options;
    options.progress = [&stop](int, double) { return !stop; };
    pose_graph::run(batch_, options);
  }
  const pose_graph::Batch& batch() const { return batch_; }
  int generation() const { return generation_; }

 private:
  pose_graph::Batch batch_;
  const int generation_;
};

}  // namespace

LivePoseGraph::LivePoseGraph(const Parameters& parameters, const std::string& robot, std::string recording,
                             const std::string& store)
    : parameters_(parameters),
      recording_(std::move(recording)),
      graph_(parameters),
      link_(store,
            [] {
              urban_nav_live::StoreWriterLink::Options options;
              options.writer = GraphStoreWriter::writerOptions();
              return options;
            }()),
      namer_(robot) {
  findReference(parameters.solver, {});  // throws: no reference solvers are available
}

LivePoseGraph::~LivePoseGraph() {
  endSession();
  if (writer_) writer_->flush(graph_);
}

void LivePoseGraph::follow(const urban_nav_core::SessionStep& step) {
  const bool is_next =
      step.session ? step.session->id != announced_ : session_.empty() || odometry_time_.jumpsBack(step.from);
  if (!is_next) return;
  prepareSession(step.from);
  announced_ = urban_nav_core::sessionId(step.session);
  announced_start_ = step.session ? step.session->start : step.from;
  const std::vector<urban_nav_store::Session> resumable = resumableSessions();
  const bool is_resumable = graph_.hasSession(announced_) && resumable_.count(announced_) > 0;
  // An id whose poses were reset or loaded from elsewhere is not reused.
  if (step.session && (is_resumable || !namer_.isReserved(announced_)))
    return beginSession(namer_.follow(*step.session, resumable));
  beginSession(nameSession(step.session ? step.session->recording : recording_, step.from));
}

void LivePoseGraph::prepareSession(StampNs start) {
  endSession();
  if (!session_.empty()) {
    std::deque<Held> others;  // closures may name the next session before its odometry arrives
    const auto never_comes = [this](const NodeRef& node) {
      return node.session.empty() || (node.session == session_ && node.stamp > newest());
    };
    for (Held& held : std::exchange(held_, {}))
      if (never_comes(held.closure.a) || never_comes(held.closure.b)) ++given_up_;
      else others.push_back(std::move(held));
    held_ = std::move(others);
    session_ended_ = newest() > 0;
  }
  forces_.beginSession();
  ground_.beginSession();
  start_ = start;
  level_at_ = start + kFirstLevel;
  forces_at_ = start + kForcesPeriod;
  fixes_at_ = start + kFixesPeriod;
  odometry_time_.reset();
  odometry_time_.advance(start);
}

std::vector<urban_nav_store::Session> LivePoseGraph::resumableSessions() const {
  std::vector<urban_nav_store::Session> resumable;
  for (const SessionId& id : resumable_)
    if (graph_.hasSession(id)) resumable.push_back(sessions_.at(id));
  return resumable;
}

urban_nav_live::SessionNamer::Named LivePoseGraph::nameSession(const std::string& recording, StampNs start) {
  const auto endsAt = [this](const urban_nav_store::Session& session, StampNs stamp) {
    const Track* track = graph_.track(session.id);
    return track != nullptr && !track->stamps.empty() && track->stamps.back() == stamp;
  };
  return namer_.begin(recording, start, resumableSessions(), endsAt);
}

void LivePoseGraph::beginSession(const urban_nav_live::SessionNamer::Named& named) {
  ++sessions_begun_;
  session_ = named.session.id;
  if (named.resumed) {
    graph_.goOn(session_);
    resumable_.erase(session_);
  } else {
    graph_.beginSession(session_);
  }
  writeSession(named.session);
  revisions_.resize(graph_.tracks().size());
}

void LivePoseGraph::writeSession(const urban_nav_store::Session& session) {
  sessions_[session.id] = session;
  if (writer_) writer_->put(session, listParameters(parameters_));
}

void LivePoseGraph::endSession() {
  if (session_.empty()) return;
  urban_nav_store::Session& session = sessions_.at(session_);
  session.complete = true;
  if (writer_) writer_->put(session);
}

void LivePoseGraph::add(const urban_nav_core::SessionStep& step) {
  follow(step);
  odometry_time_.advance(step.to);
  const Track* track = running();
  const bool is_gap = track != nullptr && !track->stamps.empty() && step.from > track->stamps.back();
  if (!graph_.addOdometry(session_, step)) return;
  changed_ = changed_ || is_gap;  // so that the state of the graph is published
  const auto& tracks = graph_.tracks();
  for (std::size_t i = 0; i < tracks.size(); ++i)
    if (tracks[i].session == session_) revisions_[i].grow(tracks[i].stamps.size(), graph_.revision());
  updateMapToOdom();
  if (step.to >= forces_at_) putGravity();
  if (step.to >= level_at_) level();
  addHeldClosures();
}

void LivePoseGraph::add(const urban_nav_core::StampedPose& odometry) {
  map_to_odom_.addOdometry(odometry);
  updateMapToOdom();
}

void LivePoseGraph::add(const PositionFix& fix) {
  if (!parameters_.gps) return;
  if (session_.empty()) {  // odometry lags by a window
    if (early_fixes_.size() == kMostEarlyFixes) early_fixes_.pop_front();
    early_fixes_.push_back(fix);
    return;
  }
  for (const PositionFix& early : std::exchange(early_fixes_, {})) graph_.putFixes(session_, {early});
  graph_.putFixes(session_, {fix});
  if (fix.reading.stamp < fixes_at_) return;
  fixes_at_ = fix.reading.stamp + kFixesPeriod;
  fixes_due_ = true;
}

void LivePoseGraph::putGravity() {
  forces_at_ = newest() + kForcesPeriod;
  const Track* track = running();
  if (track == nullptr) return;
  graph_.putForces(session_, forces_.meansAt(track->stamps));
  const std::vector<GroundNormal> normals = ground_.takeAt(*track);
  if (forces_.empty()) graph_.putGround(session_, normals);
}

void LivePoseGraph::level() {
  level_at_ = start_ + 2 * (newest() - start_);
  if (graph_.isLevel(session_)) return;
  putGravity();
  if (const auto levelled = graph_.level()) ready_.push_back(finish(*levelled));
}

void LivePoseGraph::add(const urban_nav_core::MetricClosure& closure) {
  addOrHold(toClosure(closure), toEvidence(closure));
}

void LivePoseGraph::add(const urban_nav_core::RelativeConstraint& constraint) { addOrHold(toClosure(constraint), ""); }

NodeRef LivePoseGraph::toNode(const PoseRef& ref) const { return {findSession(ref.session, ref.stamp), ref.stamp}; }

bool LivePoseGraph::isAhead(const NodeRef& node, int sessions) const {
  if (node.session.empty()) return true;
  if (node.session == session_) return node.stamp > newest();
  return !announced_.empty() && !graph_.hasSession(node.session) && sessions == sessions_begun_;
}

bool LivePoseGraph::isAhead(const Held& held) const {
  return isAhead(held.closure.a, held.sessions) || isAhead(held.closure.b, held.sessions);
}

SessionId LivePoseGraph::findSession(const SessionId& named, StampNs stamp) const {
  if (named.empty()) return session_;
  if (named != announced_ || announced_ == session_) return named;
  const Track* before = graph_.track(named);  // from before new_session was called
  return before != nullptr && !before->stamps.empty() && stamp <= before->stamps.back() ? named : session_;
}

void LivePoseGraph::nameSessions(Closure& closure) const {
  closure.a.session = findSession(closure.a.session, closure.a.stamp);
  closure.b.session = findSession(closure.b.session, closure.b.stamp);
}

void LivePoseGraph::addOrHold(Closure closure, const std::string& evidence) {
  nameSessions(closure);
  Held held{std::move(closure), evidence, sessions_begun_};
  if (!isAhead(held)) return addClosure(held.closure, held.evidence);
  if (held_.size() == kMaxHeld) {
    held_.pop_front();
    ++given_up_;
  }
  held_.push_back(std::move(held));
}

void LivePoseGraph::addClosure(const Closure& closure, const std::string& evidence) {
  if (closure.verdict == ClosureVerdict::Rejected) {
    if (!writer_) return;
    urban_nav_store::Edge edge = toEdge(closure);
    edge.measured.information.setZero();  // no constraint; not read back into a graph
    edge.weight = 0.0;
    writer_->putRejected(edge, evidence);
    return;
  }
  graph_.addClosure(closure);
  if (writer_ && !evidence.empty()) writer_->putEvidence(toEdge(closure), evidence);
  changed_ = true;
}

void LivePoseGraph::addHeldClosures() {
  std::deque<Held> held;
  std::string refusal;
  for (Held& each : std::exchange(held_, {})) {
    nameSessions(each.closure);  // for closures that arrived before the first odometry of their session
    if (isAhead(each)) {
      held.push_back(std::move(each));
      continue;
    }
    try {
      addClosure(each.closure, each.evidence);
    } catch (const UserError& error) {
      refusal = error.what();
    }
  }
  held_ = std::move(held);
  if (!refusal.empty()) throw UserError("", refusal, "");
}

LiveGraph::Outcome LivePoseGraph::relax() {
  if (!ready_.empty()) {
    Outcome outcome = std::move(ready_.front());
    ready_.pop_front();
    return outcome;
  }
  changed_ = is_exact_ = false;
  return finish(graph_.update());
}

std::unique_ptr<LiveGraph::Batch> LivePoseGraph::beginBatch() {
  batch_due_ = session_ended_ = fixes_due_ = false;
  putGravity();
  return std::make_unique<LiveBatch>(graph_.batch(), generation_);
}

std::optional<LiveGraph::Outcome> LivePoseGraph::finishBatch(const Batch& batch) {
  const auto& done = dynamic_cast<const LiveBatch&>(batch);
  // A pending batch required for other reasons would replace this one immediately.
  if (done.generation() != generation_ || batch_due_) return std::nullopt;
  putGravity();
  changed_ = false;
  is_exact_ = true;
  return finish(graph_.take(done.batch()));
}

void LivePoseGraph::syncStore() {
  StoredGraph stored;
  if (link_.open([&stored](urban_nav_store::Store& store) { stored = readGraph(store); })) {
    writer_ = std::make_unique<GraphStoreWriter>(link_.writer(), stored.revision);
    for (const auto& [id, session] : sessions_) writer_->put(session, listParameters(parameters_));
    addStored(stored, true);
  }
  if (writer_) writer_->sync(graph_, is_exact_);
}

std::string LivePoseGraph::load(const StoredGraph& stored) {
  const Loaded loaded = addStored(stored, false);
  return std::to_string(loaded.sessions) + " sessions with " + std::to_string(loaded.poses) + " poses and " +
         std::to_string(loaded.closures) + " closures are in the graph" +
         (loaded.refused > 0 ? "; " + std::to_string(loaded.refused) + " closures were rejected as invalid" : "") +
         (loaded.known > 0 ? "; " + std::to_string(loaded.known) + " sessions were already loaded" : "");
}

LivePoseGraph::Loaded LivePoseGraph::addStored(const StoredGraph& stored, bool own) {
  Loaded loaded;
  for (const StoredGraph::Chain& chain : stored.chains) {
    const SessionId& id = chain.session.id;
    if (graph_.hasSession(id)) {
      ++loaded.known;
      continue;
    }
    graph_.beginSession(id);
    for (const urban_nav_core::RelativePose& step : chain.steps) graph_.addOdometry(id, step);
    graph_.putForces(id, chain.forces);
    graph_.putGround(id, chain.ground);
    graph_.putFixes(id, chain.fixes);
    const std::size_t track = graph_.tracks().size() - 1, poses = graph_.tracks().back().stamps.size();
    sessions_[id] = chain.session;
    if (own) {
      resumable_.insert(id);
      writer_->markStored(graph_, track);
    } else {
      namer_.reserve(id);
      if (writer_) writer_->put(chain.session);
    }
    revisions_.resize(track + 1);
    revisions_.back().grow(poses, graph_.revision());
    ++loaded.sessions;
    loaded.poses += poses;
  }
  for (const Closure& closure : stored.closures) {
    try {
      if (graph_.findClosure(closure.a, closure.b, closure.kind, closure.source)) continue;
      const ClosureId id = graph_.addClosure(closure);
      if (own) writer_->markStored(graph_.closures().at(id));
      else if (writer_ && closure.odometry_gate) writer_->putEvidence(toEdge(closure), toEvidence(true));
      ++loaded.closures;
    } catch (const UserError&) {
      ++loaded.refused;
    }
  }
  if (!session_.empty()) graph_.goOn(session_);
  if (loaded.poses > 0) changed_ = batch_due_ = true;
  return loaded;
}

urban_nav_live::StoreState LivePoseGraph::storeState() const {
  urban_nav_live::StoreState state = link_.state();
  if (writer_) state.lost += writer_->lost();
  return state;
}

urban_nav_core::Status LivePoseGraph::status() const {
  const std::string fault = link_.state().fault;
  if (fault.empty()) return graph_.status();
  return {urban_nav_core::Health::Degraded, static_cast<int>(Trouble::NotStored), "nothing is stored: " + fault};
}

std::string LivePoseGraph::warning() const {
  constexpr double kTolerated = 1.0;  // s, until a stage that is started with the odometry is connected to it
  const Track* track = running();
  if (session_ != announced_ || track == nullptr || track->stamps.empty()) return {};
  const double missing = urban_nav_core::secondsBetween(announced_start_, track->stamps.front());
  if (missing <= kTolerated) return {};
  return "the graph lacks the first " + std::to_string(std::lround(missing)) +
         " s of the session, from before it received odometry";
}

LiveGraph::Outcome LivePoseGraph::finish(const Relaxed& relaxed) {
  updateMapToOdom();
  for (const Relaxed::Run& run : relaxed.moved) revisions_[run.track].setMoved({run.first, run.last}, relaxed.revision);
  Outcome outcome = toOutcome(relaxed, graph_);
  outcome.verdicts = verdicts_.take(graph_);
  outcome.figures.closures_given_up = given_up_;
  outcome.status = status();
  outcome.reason_name = toString(static_cast<Trouble>(outcome.status.reason));
  return outcome;
}

StampNs LivePoseGraph::newest() const {
  const Track* track = running();
  return track == nullptr || track->stamps.empty() ? 0 : track->stamps.back();
}

LiveGraph::Picture LivePoseGraph::picture() const { return toPicture(graph_, session_); }

LiveGraph::Trajectory LivePoseGraph::trajectory(StampNs from, StampNs to, std::int64_t since) const {
  return toTrajectory(graph_, revisions_, from, to, since);
}

LiveGraph::EdgeReply LivePoseGraph::addEdge(const Closure& edge) {
  Closure named = edge;
  nameSessions(named);
  const ClosureId id = graph_.addClosure(named);
  changed_ = false;
  ready_.push_back(finish(graph_.update()));
  const Closure& judged = graph_.closures().at(id);
  EdgeReply reply;
  reply.message = std::string(toString(judged.verdict)) + (judged.reason.empty() ? "" : ": " + judged.reason);
  for (const ClosureId other : judged.contradicted_by)
    if (const auto found = graph_.closures().find(other); found != graph_.closures().end())
      reply.contradicting.push_back(toEdgeRef(found->second));
  return reply;
}

LiveGraph::EdgeReply LivePoseGraph::removeEdge(const EdgeRef& edge) {
  const NodeRef a = toNode(edge.a), b = toNode(edge.b);
  std::vector<ClosureId> meant;
  std::string between;
  for (const auto& [id, closure] : graph_.closures()) {
    if (!(closure.a == a && closure.b == b)) continue;
    between += (between.empty() ? "" : ", ") + std::string(toString(closure.kind)) + " of " + closure.source;
    const bool fits = (edge.kind.empty() || urban_nav_store::parseEdgeKind(edge.kind) == closure.kind) &&
                      (edge.source.empty() || edge.source == closure.source);
    if (fits) meant.push_back(id);
  }
  if (meant.size() != 1) {
    throw UserError("", meant.empty() ? "no such edge" : "more than one edge",
                    between.empty() ? "no edge between these poses from a to b" : between);
  }
  graph_.removeClosure(meant.front());
  changed_ = batch_due_ = true;  // its effect on the poses must be undone
  return {"removed; the graph is relaxed without it", {}};
}

LiveGraph::DeferredTask LivePoseGraph::save(const std::string& path) {
  if (writer_) {
    writer_->flush(graph_);
    return [writer = writer_->writer(), own = link_.path(), path]() -> std::string {
      writer->flush();
      if (const std::string fault = writer->counts().fault; !fault.empty()) throw UserError("", fault, "");
      std::error_code error;
      if (std::filesystem::equivalent(own, path, error)) return "already committed";
      copyStore(own, path);
      return "copied from " + own;
    };
  }
  // Without a store, writes a copy of the graph.
  return [graph = graph_, sessions = sessions_, path] { return writeStore(graph, sessions, path); };
}

std::string LivePoseGraph::newSession(const std::string& name) {
  if (session_.empty()) throw UserError("", "no session is being recorded: the first odometry begins one", "");
  const StampNs start = newest();
  prepareSession(start);
  beginSession(nameSession(name.empty() ? recording_ : name, start));
  return session_;
}

void LivePoseGraph::reset() {
  endSession();
  if (writer_) {
    writer_->flush(graph_);
    writer_->reset();
    for (const auto& [id, session] : sessions_) namer_.reserve(id);  // the store contains them
  } else {
    sessions_.clear();
    namer_.clear();
  }
  graph_ = PoseGraph(parameters_, graph_.revision() + 1);  // must differ from revisions of the previous graph
  session_.clear();
  announced_.clear();
  odometry_time_.reset();
  resumable_.clear();
  held_.clear();
  revisions_.clear();
  ready_.clear();
  changed_ = batch_due_ = session_ended_ = fixes_due_ = false;
  ++generation_;
  verdicts_.clear();
  map_to_odom_.forgetSessions();
  updateMapToOdom();
}

}  // namespace pose_graph
