// SPDX-License-Identifier: BSD-3-Clause
#include "live/verdict_changes.hpp"

#include "live/graph_output.hpp"

namespace pose_graph {

using urban_nav_core::ClosureMethod;
using urban_nav_core::MetricClosure;

namespace {

MetricClosure toMetricClosure(const Closure& closure) {
  MetricClosure metric;
  metric.a = toPoseRef(closure.a);
  metric.b = toPoseRef(closure.b);
  metric.measured = closure.measured;
  if (closure.verdict == ClosureVerdict::Rejected) metric.measured.information.setZero();
  metric.method = closure.kind == EdgeKind::Icp ? ClosureMethod::Icp : ClosureMethod::Stereo;
  metric.odometry_gate = closure.odometry_gate;
  metric.verdict = closure.verdict;
  metric.sentence = closure.reason;
  metric.source = "pose_graph";
  return metric;
}

bool isDecided(const Closure& closure) {
  return closure.judged && (closure.verdict == ClosureVerdict::Accepted || closure.verdict == ClosureVerdict::Rejected);
}

}  // namespace

std::vector<MetricClosure> VerdictChanges::take(const PoseGraph& graph) {
  std::vector<MetricClosure> changes;
  for (const auto& [id, closure] : graph.closures()) {
    if ((closure.kind != EdgeKind::Stereo && closure.kind != EdgeKind::Icp) || !isDecided(closure)) continue;
    const auto [known, is_new] = known_.try_emplace(id, closure.verdict);
    if (!is_new && known->second == closure.verdict) continue;
    known->second = closure.verdict;
    changes.push_back(toMetricClosure(closure));
  }
  return changes;
}

}  // namespace pose_graph
