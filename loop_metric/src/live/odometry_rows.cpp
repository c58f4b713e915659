// SPDX-License-Identifier: BSD-3-Clause
#include "live/odometry_rows.hpp"

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_registration/session/session_odometry.hpp"

namespace loop_metric {

using urban_nav_core::Matrix6d;
using urban_nav_core::RelativePose;
using urban_nav_registration::isUsable;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::Node;
using urban_nav_store::SessionId;

bool OdometryRows::write(const SessionId& session, const RelativePose& step, std::vector<Node>& nodes,
                         std::optional<Edge>& edge) {
  if (!isUsable(step) || (newest_ && step.from < newest_->stamp)) return false;
  if (!newest_ || step.from > newest_->stamp) {
    Node first;
    first.stamp = step.from;
    // After a gap the chain continues from its last pose, as there is no better estimate.
    if (newest_) first.T_odom_base = newest_->T_odom_base;
    newest_ = first;
    nodes.push_back(first);
  }
  Node node;
  node.stamp = step.to;
  node.T_odom_base = newest_->T_odom_base * step.T_from_to;
  node.covariance = step.covariance;
  node.drift_covariance = step.drift_covariance;
  node.constants = step.constants;
  node.status = step.status.health;
  nodes.push_back(node);
  newest_ = node;
  edge.emplace();
  edge->a = {session, step.from};
  edge->b = {session, step.to};
  edge->kind = EdgeKind::Odometry;
  edge->source = step.source;
  edge->measured.T_a_b = step.T_from_to;
  edge->measured.information = urban_nav_core::invertPositiveDefinite(step.covariance).value_or(Matrix6d::Zero());
  return true;
}

}  // namespace loop_metric
