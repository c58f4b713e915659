// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "felt.hpp"
#include "last_moved.hpp"
#include "live_graph.hpp"
#include "odom_tie.hpp"
#include "offered.hpp"
#include "pose_graph/pose_graph.hpp"
#include "store_link.hpp"

namespace pose_graph {

/// The stage as the nodelet sees it: names the running session, holds closures back until odometry has reached their
/// poses, turns what a relaxation did into what goes out, and keeps all of it in a store.
///
/// A session that the store has goes on where robot, recording and a stamp say that it is the same: it has begun at the same
/// time (the recording is played again), or the first step begins at its newest pose. Else another one begins.
class StageGraph : public LiveGraph {
 public:
  /// `store`: the file; empty: none.
  StageGraph(const Parameters& parameters, std::string robot, std::string recording, const std::string& store = "");
  ~StageGraph() override;

  void add(const urban_nav_core::RelativePose& relative) override;
  /// A rejected one is evidence for the store alone.
  void add(const urban_nav_core::MetricClosure& closure) override;
  void add(const urban_nav_core::RelativeConstraint& constraint) override;

  void add(const urban_nav_core::StampedPose& odometry) override;
  void add(const SpecificForce& sample) override { felt_.add(sample); }

  bool wantsRelaxation() const override { return (changed_ && !batch_due_) || !ready_.empty(); }
  Outcome relax() override;
  bool wantsBatch() const override { return batch_due_ || session_ended_; }
  std::unique_ptr<Work> batch() override;
  std::optional<Outcome> take(const Work& work) override;

  void keep() override;
  StoreState storeState() const override { return link_.state(); }
  urban_nav_core::Status status() const override;

  std::int64_t revision() const override { return graph_.revision(); }
  StampNs newest() const override;
  std::optional<Pose> T_map_odom() const override { return T_map_odom_; }
  Picture picture() const override;
  Trajectory trajectory(StampNs from, StampNs to, std::int64_t since) const override;

  EdgeReply addEdge(const urban_nav_core::EdgeRef& edge, const urban_nav_core::Constraint& measured) override;
  EdgeReply removeEdge(const urban_nav_core::EdgeRef& edge) override;
  Rest save(const std::string& path) override;
  std::string load(const StoredGraph& stored) override;
  std::string newSession(const std::string& name) override;
  void reset() override;

 private:
  struct TakenIn {
    std::size_t sessions = 0, known = 0, poses = 0, closures = 0, refused = 0;
  };
  void begin(const std::string& name, StampNs start);
  /// Whether a session of the store goes on with a step from there.
  bool goOn(const std::string& name, StampNs start);
  void announce(const urban_nav_store::Session& session);
  void end();
  NodeRef nodeOf(const urban_nav_core::PoseRef& ref) const;
  /// Odometry has not come so far yet.
  bool isAhead(const NodeRef& node) const;
  bool isAhead(const Offered& offered) const;
  /// A pose that names no session is of the one that is running.
  void nameSessions(Offered& offered) const;
  void offer(Offered offered);
  void take(Offered& offered);
  void offerWaiting();
  /// `own`: from the store that the graph is kept in.
  TakenIn takeIn(const StoredGraph& stored, bool own);
  Outcome absorb(const Relaxed& relaxed);
  void tie() { T_map_odom_ = tie_.T_map_odom(running()); }
  void putForces();
  /// Levels the map, once that is worth a try.
  void level();
  urban_nav_core::PoseRun runOf(const Track& track, const LastMoved::Range& range) const;
  const Track* running() const { return graph_.track(session_); }

  Parameters parameters_;
  std::string robot_, recording_;
  PoseGraph graph_;
  StoreLink link_;
  SessionId session_;                                       // empty until there is odometry
  StampNs heard_ = 0;                                       // to where its odometry has come in this process
  std::map<SessionId, urban_nav_store::Session> sessions_;  // of the graph and of the store
  std::set<SessionId> earlier_;                             // those that an earlier process has begun
  std::deque<Offered> waiting_;                             // for odometry
  std::vector<LastMoved> moved_;                            // of each track
  std::deque<Outcome> ready_;                               // of relaxations that a service made
  bool changed_ = false;                                    // since the last relaxation
  bool batch_due_ = false;      // an update would not do: sessions were loaded, an edge is gone
  bool exactly_ = false;        // the last relaxation was a batch: every digit of it counts
  bool session_ended_ = false;  // its end is the batch's
  int beginnings_ = 0;          // of the graph: work of an earlier one is not taken
  OdomTie tie_;
  std::optional<Pose> T_map_odom_;
  Felt felt_;
  StampNs began_ = 0, level_at_ = 0,
          forces_at_ = 0;  // of the running session: its begin, when to level its map, and to take what was felt
};

}  // namespace pose_graph
