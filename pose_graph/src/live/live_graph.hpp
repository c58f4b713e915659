// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pose_graph/ground_level.hpp"
#include "pose_graph/stored_graph.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/graph_update.hpp"
#include "urban_nav_core/types/odometry_session.hpp"
#include "urban_nav_core/types/status.hpp"
#include "urban_nav_live/store_writer_link.hpp"

namespace pose_graph {

/// A closure for display: the current positions of its poses.
struct ClosureMarker {
  enum class Style { Stereo, Icp, Plane, Asserted, Session, Waiting, Rejected };
  Eigen::Vector3d p_map_a, p_map_b;
  Style style = Style::Stereo;
};

/// Figures of the graph, as in GraphState.msg.
struct Figures {
  std::int64_t revision = 0;
  std::int64_t sessions = 0, sessions_joined = 0, poses = 0, edges = 0;
  std::int64_t closures = 0, closures_rejected = 0, closures_waiting = 0;
  std::int64_t closures_given_up = 0;  ///< their poses never appeared in odometry
  double cost_before = 0.0, cost_after = 0.0, relax_ms = 0.0;
};
/// Returns "201 poses, 2 closures, 0 rejected, 0 waiting; cost 41.5 -> 12.1 in 3.2 ms".
std::string toSentence(const Figures& figures);

/// Interface of a live graph for its worker and the services. Not thread-safe. Throws UserError for user errors.
class LiveGraph {
 public:
  struct Outcome {
    std::optional<urban_nav_core::GraphUpdate> update;  ///< empty: no pose moved
    std::vector<urban_nav_core::PoseCorrection> corrections;
    std::vector<urban_nav_core::MetricClosure> verdicts;  ///< that changed (VerdictChanges)
    Figures figures;
    urban_nav_core::Status status;
    std::string reason_name;
    bool needs_batch = false;  ///< closures were tested one by one: only a batch can decide which are false
  };
  struct EdgeReply {
    std::string message;
    std::vector<urban_nav_core::EdgeRef> contradicting;
  };
  struct Trajectory {
    std::int64_t revision = 0;
    std::vector<urban_nav_core::TrajectorySegment> segments;
  };
  struct Picture {
    std::vector<urban_nav_core::TrajectorySegment> segments;  ///< the active session is last
    std::vector<ClosureMarker> closures;
  };
  /// Batch relaxation from the edges only, as in offline processing.
  class Batch {
   public:
    virtual ~Batch() = default;
    /// Relaxes. Call once, in any thread; the graph may be used meanwhile. Returns early if `stop` is set.
    virtual void run(const std::atomic<bool>& stop) = 0;
  };
  /// Remaining work of a service that does not need the graph. Call once, in any thread. Returns a message.
  using DeferredTask = std::function<std::string()>;

  virtual ~LiveGraph() = default;

  /// Adds an input; does not relax.
  virtual void add(const urban_nav_core::SessionStep& step) = 0;
  virtual void add(const urban_nav_core::MetricClosure& closure) = 0;
  virtual void add(const urban_nav_core::RelativeConstraint& constraint) = 0;
  /// Adds T_odom_base as odometry published it.
  virtual void add(const urban_nav_core::StampedPose& odometry) = 0;
  virtual void add(const SpecificForce& sample) = 0;
  virtual void add(const GroundNormal& normal) = 0;
  /// Adds a position fix of satellite navigation; used only with Parameters::gps.
  virtual void add(const PositionFix& fix) = 0;

  /// Returns whether inputs require a relaxation.
  virtual bool isRelaxationPending() const = 0;
  /// Relaxes from the current poses.
  virtual Outcome relax() = 0;

  /// Returns whether a batch is required because sessions were loaded or an edge was removed.
  virtual bool isBatchPending() const = 0;
  virtual std::unique_ptr<Batch> beginBatch() = 0;
  /// Applies a completed batch; later poses follow by odometry. Returns nullopt if the graph of the batch no longer
  /// exists.
  virtual std::optional<Outcome> finishBatch(const Batch& batch) = 0;

  /// Writes new data to the store, if any. Call about ten times a second. Does not block on the disk, except to read a
  /// store that was just opened.
  virtual void syncStore() = 0;
  virtual urban_nav_live::StoreState storeState() const = 0;
  virtual urban_nav_core::Status status() const = 0;
  /// Returns a warning about the active session, apart from that of the status; empty: none.
  virtual std::string warning() const { return {}; }

  virtual std::int64_t revision() const = 0;
  /// Returns the stamp of the newest pose of the active session; 0: none.
  virtual urban_nav_core::StampNs newest() const = 0;
  /// Returns T_map_odom of the newest odometry; empty if unknown.
  virtual std::optional<urban_nav_core::Pose> T_map_odom() const = 0;
  virtual Picture picture() const = 0;
  /// Returns the poses from `from` to `to` (0: no bound) that moved since a revision (0: all).
  virtual Trajectory trajectory(urban_nav_core::StampNs from, urban_nav_core::StampNs to, std::int64_t since) const = 0;

  /// Adds an edge manually. Poses without a session belong to the active one.
  virtual EdgeReply addEdge(const Closure& edge) = 0;
  virtual EdgeReply removeEdge(const urban_nav_core::EdgeRef& edge) = 0;
  virtual DeferredTask save(const std::string& path) = 0;
  /// Adds the sessions that are not in the graph yet; a batch follows. Returns a message.
  virtual std::string load(const StoredGraph& stored) = 0;
  /// Begins a session. Returns its id.
  virtual std::string newSession(const std::string& name) = 0;
  /// Removes everything from the graph; the store is kept.
  virtual void reset() = 0;
};

}  // namespace pose_graph
