// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "live/closure_input.hpp"
#include "live/ground_normal_buffer.hpp"
#include "live/live_graph.hpp"
#include "live/map_to_odom_estimator.hpp"
#include "live/pose_revisions.hpp"
#include "live/specific_force_buffer.hpp"
#include "live/verdict_changes.hpp"
#include "pose_graph/graph_store_writer.hpp"
#include "pose_graph/pose_graph.hpp"
#include "urban_nav_live/session_namer.hpp"
#include "urban_nav_live/store_writer_link.hpp"
#include "urban_nav_live/time_jump.hpp"

namespace pose_graph {

/// Pose graph of a live robot. Follows and resumes the sessions of odometry (urban_nav_live::SessionNamer), holds
/// closures until odometry has reached their poses, converts results of relaxations to outputs, and writes everything
/// to a store.
class LivePoseGraph : public LiveGraph {
 public:
  /// `store`: path of the store; empty: none. Throws UserError if Parameters::solver names a reference solver.
  LivePoseGraph(const Parameters& parameters, const std::string& robot, std::string recording,
                const std::string& store = "");
  ~LivePoseGraph() override;

  void add(const urban_nav_core::SessionStep& step) override;
  void add(const urban_nav_core::MetricClosure& closure) override;
  void add(const urban_nav_core::RelativeConstraint& constraint) override;
  void add(const urban_nav_core::StampedPose& odometry) override;
  void add(const SpecificForce& sample) override { forces_.add(sample); }
  void add(const GroundNormal& normal) override { ground_.add(normal); }
  void add(const PositionFix& fix) override;

  bool isRelaxationPending() const override { return (changed_ && !batch_due_) || !ready_.empty(); }
  Outcome relax() override;
  bool isBatchPending() const override { return batch_due_ || session_ended_ || fixes_due_; }
  std::unique_ptr<Batch> beginBatch() override;
  std::optional<Outcome> finishBatch(const Batch& batch) override;

  void syncStore() override;
  urban_nav_live::StoreState storeState() const override;
  urban_nav_core::Status status() const override;
  std::string warning() const override;

  std::int64_t revision() const override { return graph_.revision(); }
  StampNs newest() const override;
  std::optional<Pose> T_map_odom() const override { return T_map_odom_; }
  Picture picture() const override;
  Trajectory trajectory(StampNs from, StampNs to, std::int64_t since) const override;

  EdgeReply addEdge(const Closure& edge) override;
  EdgeReply removeEdge(const urban_nav_core::EdgeRef& edge) override;
  DeferredTask save(const std::string& path) override;
  std::string load(const StoredGraph& stored) override;
  std::string newSession(const std::string& name) override;
  void reset() override;

 private:
  struct Loaded {
    std::size_t sessions = 0, known = 0, poses = 0, closures = 0, refused = 0;
  };
  /// A closure whose poses have not appeared in odometry yet.
  struct Held {
    Closure closure;
    std::string evidence;
    int sessions = 0;  ///< number of sessions begun at its arrival
  };
  /// Begins a session if the step belongs to another one than the previous step.
  void follow(const urban_nav_core::SessionStep& step);
  void prepareSession(StampNs start);
  void beginSession(const urban_nav_live::SessionNamer::Named& named);
  urban_nav_live::SessionNamer::Named nameSession(const std::string& recording, StampNs start);
  std::vector<urban_nav_store::Session> resumableSessions() const;
  void writeSession(const urban_nav_store::Session& session);
  void endSession();
  NodeRef toNode(const urban_nav_core::PoseRef& ref) const;
  /// Returns whether the pose has not appeared in odometry yet. `sessions`: number of sessions begun when the pose was
  /// named, since a closure may name the next session before its odometry arrives.
  bool isAhead(const NodeRef& node, int sessions) const;
  bool isAhead(const Held& held) const;
  /// Returns the session of the graph that contains a pose: the active one if `named` is empty.
  SessionId findSession(const SessionId& named, StampNs stamp) const;
  void nameSessions(Closure& closure) const;
  void addOrHold(Closure closure, const std::string& evidence);
  void addClosure(const Closure& closure, const std::string& evidence);
  void addHeldClosures();
  /// `own`: read from the store that this graph is written to.
  Loaded addStored(const StoredGraph& stored, bool own);
  Outcome finish(const Relaxed& relaxed);
  void updateMapToOdom() { T_map_odom_ = map_to_odom_.estimate(running()); }
  /// Passes accelerometer data, or otherwise ground normals, to the graph.
  void putGravity();
  /// Aligns the map with gravity if possible.
  void level();
  const Track* running() const { return graph_.track(session_); }

  Parameters parameters_;
  std::string recording_;
  PoseGraph graph_;
  urban_nav_live::StoreWriterLink link_;
  std::unique_ptr<GraphStoreWriter> writer_;  // null: no store is open
  urban_nav_live::SessionNamer namer_;
  SessionId session_;  // empty: no odometry yet
  // Announced by odometry; differs from session_ after new_session and reset; empty: odometry does not announce its
  // session.
  SessionId announced_;
  StampNs announced_start_ = 0;  // first frame of the announced session
  int sessions_begun_ = 0;
  std::int64_t given_up_ = 0;                               // number of closures
  urban_nav_live::TimeJumpDetector odometry_time_;          // of the active session
  std::map<SessionId, urban_nav_store::Session> sessions_;  // of the graph and of the store
  std::set<SessionId> resumable_;                           // begun by an earlier process
  VerdictChanges verdicts_;
  std::deque<Held> held_;                 // until their poses appear in odometry
  std::vector<PoseRevisions> revisions_;  // per track
  std::deque<Outcome> ready_;             // results of relaxations made by services
  bool changed_ = false;                  // since the last relaxation
  bool batch_due_ = false;                // an update is insufficient: sessions were loaded or an edge was removed
  bool is_exact_ = false;                 // the last relaxation was a batch: poses are stored exactly
  bool session_ended_ = false;            // a batch follows
  bool fixes_due_ = false;                // enough fixes since the last batch: a batch follows
  int generation_ = 0;                    // generation of the graph; batches of earlier ones are discarded
  MapToOdomEstimator map_to_odom_;
  std::optional<Pose> T_map_odom_;
  SpecificForceBuffer forces_;
  GroundNormalBuffer ground_;
  std::deque<PositionFix> early_fixes_;  // received before the first odometry
  // Members of the active session.
  StampNs start_ = 0;
  StampNs level_at_ = 0;   // time of the next attempt to align the map with gravity
  StampNs fixes_at_ = 0;   // time of the next batch due to position fixes
  StampNs forces_at_ = 0;  // time of the next putGravity()
};

}  // namespace pose_graph
