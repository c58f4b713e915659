// SPDX-License-Identifier: BSD-3-Clause
// Time from the arrival of a closure to the updated map. A robot drives through a town; closures arrive one at a time
// when their later pose is reached, with the odometry since the last one, as on a robot; a further 20 % are false.
// Processor time of each PoseGraph::update().
//   pose_graph-bench-update [--largest POSES] [-o results/update.json]
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/pose_graph.hpp"
#include "support/program.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/false_closures.hpp"
#include "urban_nav_core/testing/street_graph.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using namespace urban_nav_core::testing;

constexpr StampNs kStep = 50'000'000;  // 20 Hz

struct Size {
  int poses, closures;
};
constexpr Size kSizes[] = {{5000, 50}, {20000, 200}, {20000, 2000}, {100000, 1000}};

urban_nav_core::RelativePose toStep(const GraphEdge& edge) {
  urban_nav_core::RelativePose step;
  step.from = static_cast<StampNs>(edge.a) * kStep;
  step.to = static_cast<StampNs>(edge.b) * kStep;
  step.T_from_to = edge.T_a_b;
  step.covariance = edge.information.inverse();
  step.drift_covariance = step.covariance;
  return step;
}

Closure toClosure(const GraphEdge& edge) {
  Closure closure;
  closure.a = {"drive", static_cast<StampNs>(edge.a) * kStep};
  closure.b = {"drive", static_cast<StampNs>(edge.b) * kStep};
  closure.kind = EdgeKind::Stereo;
  closure.odometry_gate = true;  // accepted without confirmation: every closure is relaxed on arrival
  closure.measured.T_a_b = edge.T_a_b;
  closure.measured.information = edge.information;
  return closure;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted.empty() ? 0.0 : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
}

/// Root mean square distance between the live poses and those of the batch, m.
double offBy(const std::vector<Pose>& live, const std::vector<Pose>& batch) {
  double sum = 0.0;
  for (std::size_t i = 0; i < live.size(); ++i) sum += (live[i].t() - batch[i].t()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(live.size()));
}

void addSize(BenchTable& table, const Size& size) {
  StreetOptions streets;
  streets.step_m = 0.25;
  SimulatedGraph drive = streetGraph(static_cast<std::size_t>(size.poses), static_cast<std::size_t>(size.closures),
                                     streetNoise(), 1, streets);
  addFalseClosures(drive, FalseClosures::Random, static_cast<std::size_t>(size.closures / 5), 1);
  const auto begin = std::find_if(drive.edges.begin(), drive.edges.end(),
                                  [](const GraphEdge& edge) { return edge.kind == GraphEdgeKind::Closure; });
  std::vector<GraphEdge> closures(begin, drive.edges.end());
  drive.edges.erase(begin, drive.edges.end());
  std::stable_sort(closures.begin(), closures.end(), [](const GraphEdge& one, const GraphEdge& other) {
    return std::max(one.a, one.b) < std::max(other.a, other.b);
  });
  PoseGraph graph{Parameters()};
  std::vector<double> seconds;
  std::vector<std::pair<ClosureId, bool>> wrong;
  std::size_t next = 0;
  for (const GraphEdge& closure : closures) {
    for (; next < std::max(closure.a, closure.b); ++next) graph.addOdometry("drive", toStep(drive.edges[next]));
    wrong.emplace_back(graph.addClosure(toClosure(closure)), closure.wrong);
    seconds.push_back(measureSeconds(1, [&] { graph.update(); }));
  }
  std::size_t kept = 0, lost = 0;
  for (const auto& [id, is_wrong] : wrong) {
    const bool accepted = graph.closures().at(id).weight > 0.0;
    kept += is_wrong && accepted;
    lost += !is_wrong && !accepted;
  }
  const std::vector<Pose> live = graph.tracks()[0].map;
  // Batch with the closures accepted live.
  for (const auto& [id, is_wrong] : wrong)
    if (!(graph.closures().at(id).weight > 0.0)) graph.removeClosure(id);
  const Problem<3> problem = graph.problem();
  std::vector<Pose> batch;
  const double batch_seconds = measureSeconds(1, [&] {
    for (const Rigid<3>& pose : solve(problem, {}).poses) batch.push_back(toPose(pose));
  });
  std::sort(seconds.begin(), seconds.end());
  table.add({std::to_string(size.poses), std::to_string(size.closures), std::to_string(size.closures / 5),
             cell(1e3 * quantile(seconds, 0.5), 2), cell(1e3 * quantile(seconds, 0.95), 2),
             cell(1e3 * seconds.back(), 1), cell(1e3 * batch_seconds, 0), cell(1e3 * offBy(live, batch), 3),
             std::to_string(kept), std::to_string(lost)});
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--largest"});
  const int largest = asked.number("--largest", 100000);
  const urban_nav_core::ThreadLimit one(1);
  BenchTable table({"poses", "true closures", "false ones", "median, ms", "95 %, ms", "worst, ms",
                    "the batch at the end, ms", "off the batch, mm rms", "wrong ones kept", "true ones lost"},
                   argc, argv);
  for (const Size& size : kSizes)
    if (size.poses <= largest) addSize(table, size);
  table.note(
      "One core, processor time of each update, all closures counted. Off the batch: relative to a batch "
      "relaxation with the same accepted closures.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
