// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pose_graph/level.hpp"
#include "pose_graph/stored_graph.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/graph_update.hpp"
#include "urban_nav_core/types/status.hpp"

namespace pose_graph {

/// A closure as it is drawn: where its two poses are now.
struct Tie {
  enum class Look { Stereo, Icp, Plane, Asserted, Session, Waiting, Rejected };
  Eigen::Vector3d p_map_a, p_map_b;
  Look look = Look::Stereo;
};

/// Figures of the graph as GraphState.msg has them.
struct Figures {
  std::int64_t revision = 0;
  std::int64_t sessions = 0, sessions_joined = 0, poses = 0, edges = 0;
  std::int64_t closures = 0, closures_rejected = 0, closures_waiting = 0;
  double cost_before = 0.0, cost_after = 0.0, relax_ms = 0.0;
};

/// How it stands with the store.
struct StoreState {
  std::string path;   ///< empty: there is to be none
  std::string fault;  ///< why what is taken in does not reach it; empty: it does
  std::int64_t committed = 0, refused = 0, lost = 0;
  std::size_t waiting = 0;
};

/// What the nodelet needs of the stage: the seam between messages and graph. Used by one thread at a time. What a user has
/// done wrong is thrown as UserError.
class LiveGraph {
 public:
  struct Outcome {
    std::optional<urban_nav_core::GraphUpdate> update;  ///< empty: nothing moved
    std::vector<urban_nav_core::MapJump> jumps;
    Figures figures;
    urban_nav_core::Status status;
    std::string reason_name;
    bool needs_batch = false;  ///< a closure disagrees: only the batch can tell who is wrong
  };
  struct EdgeReply {
    std::string message;
    std::vector<urban_nav_core::EdgeRef> contradicting;
  };
  struct Trajectory {
    std::int64_t revision = 0;
    std::vector<urban_nav_core::PoseRun> runs;
  };
  struct Picture {
    std::vector<urban_nav_core::PoseRun> runs;  ///< the running session last
    std::vector<Tie> ties;
  };
  virtual ~LiveGraph() = default;

  /// Take in; cheap.
  virtual void add(const urban_nav_core::RelativePose& relative) = 0;
  virtual void add(const urban_nav_core::MetricClosure& closure) = 0;
  virtual void add(const urban_nav_core::RelativeConstraint& constraint) = 0;
  /// T_odom_base, as odometry gave it out.
  virtual void add(const urban_nav_core::StampedPose& odometry) = 0;
  virtual void add(const SpecificForce& sample) = 0;

  /// Whether what was added asks for a relaxation.
  virtual bool wantsRelaxation() const = 0;
  /// Relaxes from where the graph is.
  virtual Outcome relax() = 0;

  /// Whether only a batch would do: sessions were loaded, an edge is gone.
  virtual bool wantsBatch() const = 0;
  /// A batch relaxation: from the edges alone, as the offline run does.
  class Work {
   public:
    virtual ~Work() = default;
    /// To be called once, in any thread, while the graph goes on; returns early where it is to `stop`.
    virtual void run(const std::atomic<bool>& stop) = 0;
  };
  virtual std::unique_ptr<Work> batch() = 0;
  /// Lays the graph as work that has run says, and what came meanwhile behind it. Empty: what it was of is no more.
  virtual std::optional<Outcome> take(const Work& work) = 0;

  /// Hands what is new to the store, where there is one; to be called some ten times a second. Never waits for the disk, but to
  /// read a store that has just been opened.
  virtual void keep() = 0;
  virtual StoreState storeState() const = 0;
  virtual urban_nav_core::Status status() const = 0;

  virtual std::int64_t revision() const = 0;
  /// Stamp of the newest pose of the running session; 0: none.
  virtual urban_nav_core::StampNs newest() const = 0;
  /// For the odometry that came last; empty: not known yet.
  virtual std::optional<urban_nav_core::Pose> T_map_odom() const = 0;
  virtual Picture picture() const = 0;
  /// Poses from `from` to `to` (0: no bound) that moved since that revision (0: all).
  virtual Trajectory trajectory(urban_nav_core::StampNs from, urban_nav_core::StampNs to, std::int64_t since) const = 0;

  virtual EdgeReply addEdge(const urban_nav_core::EdgeRef& edge, const urban_nav_core::Constraint& measured) = 0;
  virtual EdgeReply removeEdge(const urban_nav_core::EdgeRef& edge) = 0;
  /// What is left to be done for it without the graph, and may take its time: to be called in any thread, and says what was done.
  using Rest = std::function<std::string()>;
  virtual Rest save(const std::string& path) = 0;
  /// Takes in the sessions that are not there yet, and says so; a relaxation follows.
  virtual std::string load(const StoredGraph& stored) = 0;
  /// The id of the session that has begun.
  virtual std::string newSession(const std::string& name) = 0;
  /// Forgets everything.
  virtual void reset() = 0;
};

}  // namespace pose_graph
