// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/session_odometry.hpp"

#include <map>

namespace urban_nav_registration {

using urban_nav_core::OdometryChain;
using urban_nav_core::RelativePose;
using urban_nav_core::StampNs;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::Node;
using urban_nav_store::SessionId;

bool isUsable(const RelativePose& step) {
  return step.T_from_to.isFinite() && step.covariance.allFinite() && step.drift_covariance.allFinite() &&
         step.to > step.from;
}

bool SessionOdometry::add(const RelativePose& step) {
  if (!isUsable(step) || (!empty() && step.from < newest())) return false;
  if (empty() || step.from > newest()) parts_.push_back(std::make_shared<OdometryChain>());
  return parts_.back()->append(step);
}

std::size_t SessionOdometry::partAt(StampNs stamp) const {
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (parts_[i]->nearestFrame(stamp)) return i;
  return parts_.empty() ? 0 : parts_.size() - 1;
}

StampNs SessionOdometry::newest() const { return parts_.empty() ? 0 : parts_.back()->trajectory().back().stamp; }

SessionOdometry readOdometry(urban_nav_store::Store& store, const SessionId& session) {
  SessionOdometry odometry;
  std::map<StampNs, Edge> steps;  // by end stamp
  store.graph().forEachEdge(session, [&](const Edge& edge) {
    if (edge.kind == EdgeKind::Odometry && edge.b.session == session) steps.emplace(edge.b.stamp, edge);
  });
  std::optional<Node> last;
  store.graph().forEachNode(session, [&](const Node& node) {
    // The first pose of a part has no step.
    if (last && !node.covariance.isZero(0.0)) {
      RelativePose step;
      step.from = last->stamp;
      step.to = node.stamp;
      const auto edge = steps.find(node.stamp);
      step.T_from_to = edge != steps.end() && edge->second.a.stamp == step.from
                           ? edge->second.measured.T_a_b
                           : last->T_odom_base.inverse() * node.T_odom_base;
      step.covariance = node.covariance;
      step.drift_covariance = node.drift_covariance;
      step.constants = node.constants;
      odometry.add(step);
    }
    last = node;
  });
  return odometry;
}

}  // namespace urban_nav_registration
