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

/// Where the robot was at a time, as odometry says: settled, final.
struct Node {
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::Pose T_odom_base;
  /// Of the motion since the node before (convention of PoseWithCovariance, parent: that node); zero in the first node.
  urban_nav_core::Matrix6d covariance = urban_nav_core::Matrix6d::Zero();
  /// The part of it that is independent of the steps before and after, and so adds up over a way of many steps.
  urban_nav_core::Matrix6d drift_covariance = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::Health status = urban_nav_core::Health::Ok;
};

/// Where a node is after relaxation.
struct RelaxedPose {
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::Pose T_map_base;
  std::int64_t revision = 0;  ///< of the graph, when the pose last moved
};

struct NodeRef {
  SessionId session;
  urban_nav_core::StampNs stamp = 0;
};
bool operator==(const NodeRef& a, const NodeRef& b);

enum class EdgeKind { Odometry, Stereo, Icp, Plane, Session, Asserted };
/// "odometry", "stereo", "icp", "plane", "session", "asserted".
const char* toString(EdgeKind kind);
std::optional<EdgeKind> parseEdgeKind(std::string_view word);

/// A measured T_a_b. Edges of one kind between the same two nodes differ in their source.
struct Edge {
  NodeRef a, b;
  EdgeKind kind = EdgeKind::Odometry;
  std::string source;  ///< who says so: "swf_vo", "loop_metric"
  urban_nav_core::Constraint measured;
  double weight = 1.0;  ///< that relaxation gave it, 0...1
  urban_nav_core::ClosureVerdict verdict = urban_nav_core::ClosureVerdict::Accepted;  ///< not Degenerate
  std::string reason;
};

/// The pose graph: nodes of each session in order of time, edges in order of (a, b, kind, source), a and b by session id and
/// stamp. What has the same key is replaced. Poses, matrices and weights that are not finite are refused (UserError that
/// names the row), and so are quaternions not of length one: nothing that is not a number is ever in the file. A
/// number -0 comes back as 0 in poses; everything else bit by bit.
class GraphStore {
 public:
  using Stamp = urban_nav_core::StampNs;
  static constexpr Stamp kFirst = std::numeric_limits<Stamp>::min(), kLast = std::numeric_limits<Stamp>::max();
  virtual ~GraphStore() = default;

  virtual void put(const SessionId& session, const Node& node) = 0;
  virtual std::optional<Node> node(const NodeRef& ref) const = 0;
  virtual std::int64_t nodes(const SessionId& session) const = 0;  ///< how many
  /// The nodes with from <= stamp <= to. Whether none is missing is known only at the end of a whole session: DataError then.
  virtual void forEachNode(const SessionId& session, const std::function<void(const Node&)>& take, Stamp from = kFirst,
                           Stamp to = kLast) const = 0;

  virtual void put(const SessionId& session, const RelaxedPose& pose) = 0;
  virtual void forEachRelaxed(const SessionId& session, const std::function<void(const RelaxedPose&)>& take,
                              Stamp from = kFirst, Stamp to = kLast) const = 0;

  virtual void put(const Edge& edge) = 0;
  /// Does nothing where there is none with the key of `edge`.
  virtual void remove(const Edge& edge) = 0;
  /// All edges whose node a is in this session.
  virtual void forEachEdge(const SessionId& session_a, const std::function<void(const Edge&)>& take) const = 0;

  /// What the verdict on an edge rests on, in the words of the stage that made it. The edge need not be there.
  virtual void putEvidence(const Edge& edge, const std::string& bytes) = 0;
  virtual std::optional<std::string> evidence(const Edge& edge) const = 0;
};

}  // namespace urban_nav_store
