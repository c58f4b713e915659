// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "map/closure_rows.hpp"
#include "map/previous_sessions.hpp"
#include "map/session_odometry.hpp"
#include "pose_graph/edited_graph.hpp"
#include "pose_graph/ground_level.hpp"
#include "pose_graph/marginals.hpp"
#include "pose_graph/pose_graph.hpp"
#include "topics/graph/previous_closures.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav {

/// Number of loop-closing edges by verdict.
struct VerdictCounts {
  std::size_t accepted = 0, rejected = 0, waiting = 0;
  std::size_t all() const { return accepted + rejected + waiting; }
};

/// Contribution of planes measured by several passes to the graph.
struct PlaneUse {
  bool searched = false;
  std::size_t rounds = 0;  ///< relaxations with planes
  std::size_t shared = 0;  ///< constraints with reduced weight, since an accepted ICP closure uses the same beams
  double moved = 0.0;      ///< m, the largest distance by which they moved a pose within its map
  double ms = 0.0;         ///< duration of the search and of the relaxations with planes
};

/// Result of relaxing all sessions. Sessions have their names of closures.csv.
struct GraphRun {
  pose_graph::PoseGraph graph{pose_graph::Parameters()};
  pose_graph::Relaxed relaxed;
  std::vector<std::string> sessions;                    ///< names, in the order of the runs
  std::vector<urban_nav_core::MetricClosure> closures;  ///< those of previous runs, then those of this one
  /// One for each of `closures`; the id of one rejected by an edit is -1 - its index in rejected_by_hand.
  std::vector<ClosureAssessment> assessments;
  std::vector<pose_graph::Closure> rejected_by_hand;  ///< not part of the graph
  std::vector<std::int64_t> numbers;  ///< IDs of `closures` in the store, 0: none; empty before they are stored
  std::vector<std::string> warnings;
  double ms = 0.0, ms_covariances = 0.0;  ///< durations of the relaxation and of the marginal covariances
  PlaneUse planes;
  /// Marginal covariances of T_first_base of the poses of each session, if known; those of odometry without accepted
  /// closures.
  std::vector<std::vector<urban_nav_core::Matrix6d>> covariances;

  /// Returns the first session of the map of a session; the session itself if it is not joined to an earlier one.
  std::size_t findMap(std::size_t session) const;
  /// Returns findMap() of each session.
  std::vector<std::size_t> maps() const;
  /// Returns whether a session is in the map of the first session.
  bool joined(std::size_t session) const { return findMap(session) == 0; }
  std::size_t sessionsJoined() const;
  /// Return the verdicts on closures; on constraints from planes, which are not among `closures`.
  VerdictCounts closureVerdicts() const;
  VerdictCounts planeVerdicts() const;
  /// Gravity direction of the map that starts with a session, in the frame of its first pose: from the accelerometer of
  /// the first of its sessions that has one, else from the ground plane of the first one with ground. Default values
  /// for sessions in the map of another one.
  std::vector<pose_graph::Level> levels;
  /// Poses that edits make the origin of the map that starts with a session, in the order of `levels`.
  std::vector<std::optional<pose_graph::NodeRef>> origins;
  /// Returns the transform from the frame of the poses of `graph` in the map of a session to that map: its origin and
  /// heading are those of its first pose, or of the one chosen by an edit, and it is aligned with gravity if its
  /// direction is known.
  urban_nav_core::Pose mapFromGraph(std::size_t session) const;
  /// Returns the poses of a session in its map.
  urban_nav_core::Trajectory trajectory(std::size_t session) const;
};

/// Normals of the ground of each session, in the order of the runs; empty: none.
using SessionGrounds = std::vector<std::vector<pose_graph::GroundNormal>>;

/// Fixes of satellite navigation of each session, in the order of the runs; empty: none.
using SessionFixes = std::vector<std::vector<pose_graph::PositionFix>>;

/// Constraints from planes of the lasers between poses of a relaxed graph.
struct PlaneClosures {
  std::vector<pose_graph::Closure> closures;  ///< of kind Plane; sessions by their names in GraphRun::sessions
  std::size_t shared = 0;  ///< number with reduced information, since an accepted ICP closure uses some of their beams
};
using PlaneFinder = std::function<PlaneClosures(const GraphRun&)>;

/// Relaxes the smoothed odometry chains of the runs with the closures. A closure between frames without nodes is
/// transferred to the nearest nodes by odometry. A closure that cannot be used is rejected with a reason. A new closure
/// replaces a previous one of the same kind between the same poses. The poses are bit-exactly independent of the order
/// of the closures. `find_planes`: called with the relaxed graph; its constraints are used in a second relaxation and,
/// if that moves the poses, called again for a third one, which uses only the new constraints. Without it, the planes
/// of earlier runs are used. `edits`: manual changes of the measurements.
GraphRun runGraph(const pose_graph::Parameters& parameters, const std::vector<const SessionOdometry*>& runs,
                  const std::vector<std::string>& sessions, const std::vector<urban_nav_core::MetricClosure>& closures,
                  const PreviousClosures& previous = {}, const SessionGrounds& grounds = {},
                  const SessionFixes& fixes = {}, const PlaneFinder& find_planes = {},
                  std::vector<pose_graph::Edit> edits = {});

}  // namespace urban_nav
