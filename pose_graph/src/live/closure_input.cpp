// SPDX-License-Identifier: BSD-3-Clause
#include "live/closure_input.hpp"

#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::ClosureMethod;
using urban_nav_core::UserError;

namespace {

NodeRef toNodeRef(const urban_nav_core::PoseRef& ref) { return {ref.session, ref.stamp}; }

}  // namespace

Closure toClosure(const urban_nav_core::MetricClosure& closure) {
  Closure result;
  result.a = toNodeRef(closure.a);
  result.b = toNodeRef(closure.b);
  result.kind = closure.method == ClosureMethod::Icp ? EdgeKind::Icp : EdgeKind::Stereo;
  result.source = closure.source;
  result.measured = closure.measured;
  result.odometry_gate = closure.odometry_gate;
  if (closure.verdict != ClosureVerdict::Accepted || closure.method == ClosureMethod::None) {
    result.verdict = ClosureVerdict::Rejected;
    result.reason = closure.reason_name + (closure.sentence.empty() ? "" : ": " + closure.sentence);
  }
  return result;
}

Closure toClosure(const urban_nav_core::RelativeConstraint& constraint) {
  Closure result;
  result.a = toNodeRef(constraint.a);
  result.b = toNodeRef(constraint.b);
  result.kind = toEdgeKind(constraint.kind);
  result.source = constraint.source;
  result.measured = constraint.measured;
  return result;
}

EdgeKind toEdgeKind(const std::string& word) {
  const auto kind = urban_nav_store::parseEdgeKind(word);
  if (!kind || *kind == EdgeKind::Odometry || *kind == EdgeKind::Session)
    throw UserError("kind", "`" + word + "`", "asserted, stereo, icp, plane");
  return *kind;
}

}  // namespace pose_graph
