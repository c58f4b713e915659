// SPDX-License-Identifier: BSD-3-Clause
#include "live/closure_input.hpp"

#include "pose_graph/stored_graph.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::ClosureMethod;
using urban_nav_core::UserError;

namespace {

NodeRef toNodeRef(const urban_nav_core::PoseRef& ref) { return {ref.session, ref.stamp}; }

}  // namespace

ClosureInput toClosureInput(const urban_nav_core::MetricClosure& closure) {
  ClosureInput input;
  input.rejected = closure.verdict != urban_nav_core::ClosureVerdict::Accepted || closure.method == ClosureMethod::None;
  input.evidence = toEvidence(closure);
  input.closure.a = toNodeRef(closure.a);
  input.closure.b = toNodeRef(closure.b);
  input.closure.kind = closure.method == ClosureMethod::Icp ? EdgeKind::Icp : EdgeKind::Stereo;
  input.closure.source = closure.source;
  input.closure.measured = closure.measured;
  input.closure.odometry_gate = closure.odometry_gate;
  if (input.rejected)
    input.closure.reason = closure.reason_name + (closure.sentence.empty() ? "" : ": " + closure.sentence);
  return input;
}

ClosureInput toClosureInput(const urban_nav_core::RelativeConstraint& constraint) {
  ClosureInput input;
  input.closure.a = toNodeRef(constraint.a);
  input.closure.b = toNodeRef(constraint.b);
  input.closure.kind = toEdgeKind(constraint.kind);
  input.closure.source = constraint.source;
  input.closure.measured = constraint.measured;
  return input;
}

EdgeKind toEdgeKind(const std::string& word) {
  const auto kind = urban_nav_store::parseEdgeKind(word);
  if (!kind || *kind == EdgeKind::Odometry || *kind == EdgeKind::Session)
    throw UserError("kind", "`" + word + "`", "stereo, icp, plane, asserted");
  return *kind;
}

}  // namespace pose_graph
