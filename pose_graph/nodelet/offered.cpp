// SPDX-License-Identifier: BSD-3-Clause
#include "offered.hpp"

#include "pose_graph/stored_graph.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::ClosureMethod;
using urban_nav_core::UserError;

namespace {

NodeRef nodeOf(const urban_nav_core::PoseRef& ref) { return {ref.session, ref.stamp}; }

}  // namespace

Offered offeredOf(const urban_nav_core::MetricClosure& closure) {
  Offered offered;
  offered.rejected =
      closure.verdict != urban_nav_core::ClosureVerdict::Accepted || closure.method == ClosureMethod::None;
  offered.evidence = evidenceOf(closure);
  offered.closure.a = nodeOf(closure.a);
  offered.closure.b = nodeOf(closure.b);
  offered.closure.kind = closure.method == ClosureMethod::Icp ? EdgeKind::Icp : EdgeKind::Stereo;
  offered.closure.source = closure.source;
  offered.closure.measured = closure.measured;
  offered.closure.odometry_gate = closure.odometry_gate;
  if (offered.rejected)
    offered.closure.reason = closure.reason_name + (closure.sentence.empty() ? "" : ": " + closure.sentence);
  return offered;
}

Offered offeredOf(const urban_nav_core::RelativeConstraint& constraint) {
  Offered offered;
  offered.closure.a = nodeOf(constraint.a);
  offered.closure.b = nodeOf(constraint.b);
  offered.closure.kind = kindOf(constraint.kind);
  offered.closure.source = constraint.source;
  offered.closure.measured = constraint.measured;
  return offered;
}

EdgeKind kindOf(const std::string& word) {
  const auto kind = urban_nav_store::parseEdgeKind(word);
  if (!kind || *kind == EdgeKind::Odometry || *kind == EdgeKind::Session)
    throw UserError("kind", "`" + word + "`", "stereo, icp, plane, asserted");
  return *kind;
}

}  // namespace pose_graph
