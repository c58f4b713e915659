// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/results/closure_topics.hpp"

#include <algorithm>

#include "topics/loops/stored_closure.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/marker_builder.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;

namespace topics = urban_nav_ros::topics;

namespace {

constexpr double kDisplayLength = 1.0;  // m that weigh as one rad in free directions (covarianceForDisplay)
constexpr double kLineWidth = 0.1;      // m

bool isPlaceClosure(const Edge& edge) {
  return edge.kind == EdgeKind::Stereo || edge.kind == EdgeKind::Icp || edge.kind == EdgeKind::Asserted;
}

urban_nav_core::MetricClosure toClosure(const StoredClosure& stored) {
  const Edge& edge = stored.edge;
  urban_nav_core::MetricClosure closure;
  closure.a = {edge.a.session, edge.a.stamp};
  closure.b = {edge.b.session, edge.b.stamp};
  closure.measured = edge.measured;
  closure.probability = stored.probability.value_or(0.0);
  if (edge.kind == EdgeKind::Stereo) closure.method = ClosureMethod::Stereo;
  if (edge.kind == EdgeKind::Icp) closure.method = ClosureMethod::Icp;
  closure.verdict = edge.verdict;
  closure.sentence = edge.reason;
  closure.source = edge.source;
  return closure;
}

}  // namespace

void writeClosureTopics(urban_nav_store::Store& store, const RecordedMap& map, BagWriter& recording) {
  std::vector<Eigen::Vector3d> accepted, rejected;
  for (const StoredClosure& stored : listClosures(store)) {
    const Edge& edge = stored.edge;
    if (!isPlaceClosure(edge)) continue;
    const auto a = map.poseAt(edge.a.session, edge.a.stamp), b = map.poseAt(edge.b.session, edge.b.stamp);
    if (!a || !b) continue;
    recording.write(
        topics::results::kClosures, std::max(edge.a.stamp, edge.b.stamp),
        urban_nav_ros::toMetricClosureMessage(toClosure(stored), urban_nav_core::frames::kBaseLink, kDisplayLength));
    std::vector<Eigen::Vector3d>& lines = edge.verdict == ClosureVerdict::Accepted ? accepted : rejected;
    lines.insert(lines.end(), {a->t(), b->t()});
  }
  if (accepted.empty() && rejected.empty()) return;
  urban_nav_ros::MarkerBuilder markers(map.frame(), map.first());
  markers.addLines("accepted", accepted, kLineWidth, urban_nav_ros::toColour(0.1, 0.7, 0.2));
  markers.addLines("rejected", rejected, kLineWidth, urban_nav_ros::toColour(0.8, 0.2, 0.1, 0.5));
  recording.write(topics::results::kClosureMarkers, map.first(), markers.message());
}

}  // namespace urban_nav
