// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

/// A manual correction of the measurements that a graph is relaxed from.
struct Edit {
  enum class Action {
    Reject,  ///< the closure is not used, regardless of other evidence
    Accept,  ///< the closure is used, regardless of other evidence
    Add,     ///< adds a closure, which is never weighted down
    Remove,  ///< removes an added closure
    Pin,     ///< a point of the robot is fixed at a surveyed point of the map
    Cut,     ///< no odometry from one pose to the next
    Origin,  ///< the pose becomes the origin of its map
  };

  Action action = Action::Reject;
  std::int64_t number = 0;  ///< order of the edits; the last verdict on a closure applies
  /// Closure of Reject, Accept, Add and Remove; otherwise both are the pose (Cut: the pose before the gap).
  NodeRef a, b;
  EdgeKind kind = EdgeKind::Asserted;
  std::string source;                     ///< what measured the closure
  urban_nav_core::Constraint measured{};  ///< Add: T_a_b
  std::string evidence;                   ///< Add: evidence text of the measuring stage
  /// Pin: the point in base_link and in the map, m.
  Eigen::Vector3d p_base = Eigen::Vector3d::Zero(), p_map = Eigen::Vector3d::Zero();
  double sigma = 0.0;  ///< Pin: standard deviation of p_map per axis, m
};

/// Builds and relaxes a graph with edits applied. The poses depend on measurements and edits only, not on the order of
/// edits of different closures. `graph` must outlive this object. Not thread-safe.
class EditedGraph {
 public:
  EditedGraph(PoseGraph& graph, std::vector<Edit> edits);

  /// Adds a step as PoseGraph::addOdometry() does. Returns false also for a step across a cut.
  bool addOdometry(const SessionId& session, const urban_nav_core::RelativePose& step);
  /// Adds a closure as PoseGraph::addClosure() does. Returns nullopt if an edit rejects it; the closure is then in
  /// rejected().
  std::optional<ClosureId> addClosure(const Closure& offered);
  /// Adds the closures of edits. Call once, after all measured closures.
  void addOwnClosures();

  /// Calls `relax`, which relaxes the graph once, and repeats it while a closure accepted by an edit is not accepted or
  /// pins still move. `T_map_graph`: called with a session after a relaxation; returns the transform from the graph
  /// frame of its poses to its map frame.
  void relax(const std::function<void()>& relax, const std::function<Pose(const SessionId&)>& T_map_graph);

  /// Returns the closures that edits reject, with that verdict.
  const std::vector<Closure>& rejected() const { return rejected_; }
  /// A closure added by an edit. Its id is negative if it is rejected: -1 - its index in rejected().
  struct OwnClosure {
    ClosureId id = 0;
    const Edit* edit = nullptr;
  };
  const std::vector<OwnClosure>& ownClosures() const { return own_; }
  /// Returns the pose that an edit makes the origin of the map containing `session`, if any.
  std::optional<NodeRef> origin(const SessionId& session) const;
  /// Returns one sentence for each edit without effect, because its closure or pose does not exist.
  std::vector<std::string> warnings() const;

 private:
  const Edit* findVerdict(const Closure& closure) const;
  void vouch(ClosureId id, bool by_hand);
  /// Accepts closures by hand where an edit demands it. Returns whether any was not accepted before.
  bool forceAccepted();
  /// placePins(): sets the pins to the current poses in the graph. Returns the largest change, m.
  void removePins();
  double placePins(const std::function<Pose(const SessionId&)>& T_map_graph);

  PoseGraph& graph_;
  const std::vector<Edit> edits_;  ///< in ascending order of their numbers
  std::vector<Closure> rejected_;
  std::set<std::int64_t> without_effect_;  ///< numbers of edits whose closure or pose has not been found yet
  std::vector<std::pair<ClosureId, const Edit*>> accepts_;
  std::vector<OwnClosure> own_;
  std::vector<ClosureId> pins_;
};

}  // namespace pose_graph
