// SPDX-License-Identifier: BSD-3-Clause
#include "map/odometry_store_writer.hpp"

#include "map/store_keys.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace urban_nav {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;

void OdometryStoreWriter::write(const SessionOdometry& run) {
  for (; rows_ < run.frames.size(); ++rows_)
    store_.inputs().append(id_, {stream_, run.frames[rows_].stamp, run.frames[rows_].accepted});
  writeNodes(run);
}

void OdometryStoreWriter::replaceNodes(const SessionOdometry& run, const std::string& replaced) {
  std::vector<Edge> edges;
  store_.graph().forEachEdge(id_, [&](const Edge& edge) {
    if (edge.kind == EdgeKind::Odometry && edge.source == replaced) edges.push_back(edge);
  });
  for (const Edge& edge : edges) store_.graph().remove(edge);
  writeNodes(run);
}

void OdometryStoreWriter::writeNodes(const SessionOdometry& run) {
  for (; nodes_ < run.settled.size(); ++nodes_) {
    const SmoothedFrame& settled = run.settled[nodes_];
    const urban_nav_core::RelativePose& step = settled.from_previous;
    const bool first = nodes_ == 0;
    store_.graph().put(
        id_, urban_nav_store::Node{settled.stamp, settled.T_odom_base.pose,
                                   first ? Matrix6d(Matrix6d::Zero()) : step.covariance,
                                   first ? Matrix6d(Matrix6d::Zero()) : step.drift_covariance, settled.status.health,
                                   step.constants, settled.T_odom_base.covariance});
    if (first) continue;
    Edge edge{{id_, step.from},         {id_, step.to},
              EdgeKind::Odometry,       source_,
              {step.T_from_to, {}},     1.0,
              ClosureVerdict::Accepted, ""};
    edge.measured.information = urban_nav_core::invertPositiveDefinite(step.covariance).value_or(Matrix6d::Zero());
    store_.graph().put(edge);
  }
}

void OdometryStoreWriter::rewrite(const SessionOdometry& run) {
  nodes_ = 0;
  write(run);
}

void OdometryStoreWriter::writeForces(const SessionOdometry& run) {
  if (!run.forces.empty()) store_.states().put(id_, kForcesStage, packForces(run.forces));
}

}  // namespace urban_nav
