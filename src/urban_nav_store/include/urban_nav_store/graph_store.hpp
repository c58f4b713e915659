// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_core/types/status.hpp"
#include "urban_nav_store/session.hpp"

namespace urban_nav_store {

/// Final pose of the robot at a time according to odometry.
struct Node {
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::Pose T_odom_base;
  /// Covariance of the motion since the previous node, in whose frame it is given (PoseWithCovariance); zero in the
  /// first.
  urban_nav_core::Matrix6d covariance = urban_nav_core::Matrix6d::Zero();
  /// Part of the covariance that is independent of neighbouring steps, and hence accumulates along the path.
  urban_nav_core::Matrix6d drift_covariance = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::Health status = urban_nav_core::Health::Ok;
  /// Sensitivity of the motion since the previous node to constants of the rig (RelativePose::constants).
  urban_nav_core::ConsideredConstants constants{};
  /// Covariance of the pose relative to the first node, in the axes of that node; zero: unknown.
  urban_nav_core::Matrix6d covariance_from_first = urban_nav_core::Matrix6d::Zero();
};

/// Optimised pose of a node.
struct RelaxedPose {
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::Pose T_map_base;
  std::int64_t revision = 0;  ///< revision of the graph when the pose last changed
  /// Covariance of the pose relative to the first pose of its map, in the axes of that pose; zero: unknown.
  urban_nav_core::Matrix6d covariance = urban_nav_core::Matrix6d::Zero();
};
/// Identifies a node of the pose graph by session and stamp.
struct NodeRef {
  SessionId session;
  urban_nav_core::StampNs stamp = 0;
};
bool operator==(const NodeRef& a, const NodeRef& b);
/// Source of the measurement of an edge.
enum class EdgeKind { Odometry, Stereo, Icp, Plane, Session, Asserted };
/// Returns "odometry", "stereo", "icp", "plane", "session" or "asserted".
const char* toString(EdgeKind kind);
std::optional<EdgeKind> parseEdgeKind(std::string_view word);

/// Measured T_a_b. Edges of one kind between the same two nodes differ in their source.
struct Edge {
  NodeRef a, b;
  EdgeKind kind = EdgeKind::Odometry;
  std::string source;  ///< stage that measured it: "swf_vo", "loop_metric"
  urban_nav_core::Constraint measured;
  double weight = 1.0;  ///< assigned by the optimisation, 0...1
  urban_nav_core::ClosureVerdict verdict = urban_nav_core::ClosureVerdict::Accepted;  ///< not Degenerate
  std::string reason;
};

/// Pose graph: nodes of each session in order of time, edges in order of (a, b, kind, source), a and b by session id
/// and stamp. A row with the same key is replaced. Values are read back bit-exactly, except that -0 becomes 0 in poses.
/// Throws UserError naming the row for poses, matrices and weights that are not finite and for quaternions that are not
/// of unit length.
class GraphStore {
 public:
  using Stamp = urban_nav_core::StampNs;
  static constexpr Stamp kFirst = std::numeric_limits<Stamp>::min(), kLast = std::numeric_limits<Stamp>::max();
  virtual ~GraphStore() = default;

  virtual void put(const SessionId& session, const Node& node) = 0;
  virtual std::optional<Node> node(const NodeRef& ref) const = 0;
  virtual std::int64_t nodes(const SessionId& session) const = 0;  ///< number of nodes
  /// Calls `take` for nodes with from <= stamp <= to in order of time. Over a whole session, throws DataError at the
  /// end if a node is missing.
  virtual void forEachNode(const SessionId& session, const std::function<void(const Node&)>& take, Stamp from = kFirst,
                           Stamp to = kLast) const = 0;

  virtual void put(const SessionId& session, const RelaxedPose& pose) = 0;
  virtual void forEachRelaxed(const SessionId& session, const std::function<void(const RelaxedPose&)>& take,
                              Stamp from = kFirst, Stamp to = kLast) const = 0;

  virtual void put(const Edge& edge) = 0;
  /// Removes the edge with the key of `edge` and its evidence, if it exists.
  virtual void remove(const Edge& edge) = 0;
  /// Calls `take` for all edges whose node a is in this session.
  virtual void forEachEdge(const SessionId& session_a, const std::function<void(const Edge&)>& take) const = 0;

  /// Stores the evidence for the verdict on an edge, in the encoding of its stage. The edge need not exist.
  virtual void putEvidence(const Edge& edge, const std::string& bytes) = 0;
  virtual std::optional<std::string> evidence(const Edge& edge) const = 0;
};

}  // namespace urban_nav_store
