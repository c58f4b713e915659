// SPDX-License-Identifier: BSD-3-Clause
#include "map/chain_g2o.hpp"

#include <array>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/io/g2o.hpp"

namespace urban_nav {

using urban_nav_core::G2oGraph;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

namespace {

std::array<double, 7> toVertexValues(const Pose& pose) {
  return {pose.t().x(), pose.t().y(), pose.t().z(), pose.q().x(), pose.q().y(), pose.q().z(), pose.q().w()};
}

/// Returns a pose per frame and an edge per step; information in the tangent of g2o.
G2oGraph makeChainGraph(const SessionOdometry& run) {
  G2oGraph graph;
  for (std::size_t i = 0; i < run.settled.size(); ++i) {
    const auto id = static_cast<G2oGraph::Id>(i);
    graph.vertices.push_back({id, {}});
    graph.setPose(graph.vertices.back(), run.settled[i].T_odom_base.pose);
    if (i == 0) continue;
    const urban_nav_core::RelativePose& step = run.settled[i].from_previous;
    G2oGraph::Edge edge;
    edge.from = id - 1;
    edge.to = id;
    edge.values = toVertexValues(step.T_from_to);
    const Matrix6d information = urban_nav_core::invertPositiveDefinite(step.covariance).value_or(Matrix6d::Zero());
    urban_nav_core::setG2oInformation(edge, urban_nav_core::g2oFromBoxInformation(information, step.T_from_to));
    graph.edges.push_back(edge);
  }
  if (!run.settled.empty()) graph.fixed.push_back(0);
  return graph;
}

}  // namespace

std::string chainG2o(const SessionOdometry& run) { return urban_nav_core::printG2o(makeChainGraph(run)); }

}  // namespace urban_nav
