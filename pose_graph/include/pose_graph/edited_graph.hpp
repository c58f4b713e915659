// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

/// A change that a person made to the measurements that a graph is relaxed from.
struct Edit {
  enum class Action {
    Reject,  ///< the closure is left out, whatever agrees with it
    Accept,  ///< the closure takes part, whatever contradicts it
    Add,     ///< one more closure, which is never weighted down
    Remove,  ///< an added closure is taken out again
    Pin,     ///< a point of the robot lies at a surveyed place of the map
    Cut,     ///< no odometry from one pose to the next
    Origin,  ///< the pose is the origin of its map
  };

  Action action = Action::Reject;
  std::int64_t number = 0;  ///< its place among the edits; of several verdicts on one closure the last one counts
  NodeRef a, b;  ///< Reject, Accept, Add, Remove: the closure; else both are the pose; Cut: the last one before
  EdgeKind kind = EdgeKind::Asserted;
  std::string source;                     ///< that measured the closure
  urban_nav_core::Constraint measured{};  ///< Add: T_a_b
  std::string evidence;                   ///< Add: in the words of the stage that measured it
  Eigen::Vector3d p_base = Eigen::Vector3d::Zero(), p_map = Eigen::Vector3d::Zero();  ///< Pin: the point, m
  double sigma = 0.0;                                                                 ///< Pin: of p_map, each axis, m
};

/// Builds and relaxes a graph of measurements as edits have it: the poses are a function of measurements and edits
/// alone, whatever the order of edits on different closures. The graph must outlive this object. Not thread-safe.
class EditedGraph {
 public:
  EditedGraph(PoseGraph& graph, std::vector<Edit> edits);

  /// As PoseGraph::addOdometry(), but false also for a step across a cut.
  bool addOdometry(const SessionId& session, const urban_nav_core::RelativePose& step);
  /// As PoseGraph::addClosure(); nullopt if an edit rejects the closure, which is then among rejected().
  std::optional<ClosureId> addClosure(const Closure& offered);
  /// Adds the closures of edits. Required once, after all measured closures.
  void addOwnClosures();

  /// Relaxes by `relax`, which relaxes the graph as it is, and again while a closure that an edit accepts is not
  /// accepted, and while pins move their poses. `T_map_graph`: called after a relaxation with a session, returns the
  /// transform from the frame of its poses in the graph to that of its map.
  void relax(const std::function<void()>& relax, const std::function<Pose(const SessionId&)>& T_map_graph);

  /// Closures that edits reject, with that verdict.
  const std::vector<Closure>& rejected() const { return rejected_; }
  /// A closure of an edit: its id, or -1 - its place in rejected().
  struct OwnClosure {
    ClosureId id = 0;
    const Edit* edit = nullptr;
  };
  const std::vector<OwnClosure>& ownClosures() const { return own_; }
  /// The pose that edits make the origin of the map in which `session` lies.
  std::optional<NodeRef> origin(const SessionId& session) const;
  /// Sentences on edits without effect: their closure or pose is not there.
  std::vector<std::string> warnings() const;

 private:
  const Edit* findVerdict(const Closure& closure) const;
  void vouch(ClosureId id, bool by_hand);
  /// Returns whether a closure had to be forced in.
  bool forceAccepted();
  /// Removes the pins, or places them where the graph has their poses by now. Returns the largest change, m.
  void removePins();
  double placePins(const std::function<Pose(const SessionId&)>& T_map_graph);

  PoseGraph& graph_;
  const std::vector<Edit> edits_;  ///< in the order of their numbers
  std::vector<Closure> rejected_;
  std::set<std::int64_t> without_effect_;  ///< numbers of edits whose closure or pose is not there so far
  std::vector<std::pair<ClosureId, const Edit*>> accepts_;
  std::vector<OwnClosure> own_;
  std::vector<ClosureId> pins_;
};

}  // namespace pose_graph
