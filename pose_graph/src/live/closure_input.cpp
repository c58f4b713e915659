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
  Closure made;
  made.a = toNodeRef(closure.a);
  made.b = toNodeRef(closure.b);
  made.kind = closure.method == ClosureMethod::Icp ? EdgeKind::Icp : EdgeKind::Stereo;
  made.source = closure.source;
  made.measured = closure.measured;
  made.odometry_gate = closure.odometry_gate;
  if (closure.verdict != ClosureVerdict::Accepted || closure.method == ClosureMethod::None) {
    made.verdict = ClosureVerdict::Rejected;
    made.reason = closure.reason_name + (closure.sentence.empty() ? "" : ": " + closure.sentence);
  }
  return made;
}

Closure toClosure(const urban_nav_core::RelativeConstraint& constraint) {
  Closure made;
  made.a = toNodeRef(constraint.a);
  made.b = toNodeRef(constraint.b);
  made.kind = toEdgeKind(constraint.kind);
  made.source = constraint.source;
  made.measured = constraint.measured;
  return made;
}

EdgeKind toEdgeKind(const std::string& word) {
  const auto kind = urban_nav_store::parseEdgeKind(word);
  if (!kind || *kind == EdgeKind::Odometry || *kind == EdgeKind::Session)
    throw UserError("kind", "`" + word + "`", "asserted, stereo, icp, plane");
  return *kind;
}

}  // namespace pose_graph
