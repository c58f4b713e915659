// SPDX-License-Identifier: BSD-3-Clause
// Consistency of the covariances of relaxed poses. Thirty simulated graphs (spheres, lattices, drives through a town)
// from raw odometry: NEES of T_first_pose at ten poses of each, without false closures and with false closures present
// and rejected; and time to compute all marginals.
//   pose_graph-bench-covariance [--graphs N] [-o results/covariance.json]
#include <array>
#include <string>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/marginals.hpp"
#include "pose_graph/robust.hpp"
#include "pose_graph/solution.hpp"
#include "support/problems.hpp"
#include "support/program.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/false_closures.hpp"
#include "urban_nav_core/testing/street_graph.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using namespace urban_nav_core::testing;

constexpr std::size_t kPlaces = 10;

/// A drive through a town, four poses a metre.
SimulatedGraph drive(int poses, int closures, std::uint64_t seed) {
  StreetOptions streets;
  streets.step_m = 0.25;
  return streetGraph(static_cast<std::size_t>(poses), static_cast<std::size_t>(closures), streetNoise(), seed, streets);
}

SimulatedGraph makeGraph(int number) {
  const auto seed = static_cast<std::uint64_t>(number);
  switch (number % 3) {
    case 0: return sphereGraph(20, 30, 20.0, evenNoise(0.02, 0.005), seed);
    case 1: return gridGraph(10, 8, 6, 1.0, 0.1, evenNoise(0.02, 0.01), seed);
    default: return drive(4000, 60, seed);
  }
}

using Nees = std::array<double, kPlaces>;  // at ten equidistant poses

Nees computeNees(const SimulatedGraph& graph, const Problem<3>& problem, const std::vector<Rigid<3>>& poses,
                 const std::vector<double>& weights) {
  const Marginals<3> marginals(problem, poses, weights);
  Nees made{};
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const std::size_t pose = (k + 1) * (poses.size() - 1) / kPlaces;
    const urban_nav_core::PoseWithCovariance estimate{toPose(poses[0].inverse() * poses[pose]),
                                                      marginals.ofPose(static_cast<int>(pose)).covariance};
    made[k] = urban_nav_core::nees(trueRelative(graph, 0, pose), estimate).value();
  }
  return made;
}

Nees computeNees(const SimulatedGraph& graph) {
  const Problem<3> problem = std::get<Problem<3>>(makeProblem(graph, deadReckoning(graph)));
  return computeNees(graph, problem, solve(problem, {}).poses, {});
}

/// Numbers of closures over all graphs.
struct ClosureCounts {
  std::size_t wrong = 0, wrong_kept = 0, right = 0, right_lost = 0;
};

/// NEES with 20 % additional closures, all false.
Nees neesAmongFalseOnes(SimulatedGraph graph, int number, ClosureCounts& counts) {
  constexpr FalseClosures kKinds[] = {FalseClosures::Random, FalseClosures::Local, FalseClosures::RandomGrouped,
                                      FalseClosures::LocalGrouped};
  const std::size_t closures = graph.edges.size() - graph.truth.size() + 1;
  addFalseClosures(graph, kKinds[number % 4], closures / 5, static_cast<std::uint64_t>(number));
  const Problem<3> problem = std::get<Problem<3>>(makeProblem(graph, deadReckoning(graph)));
  std::vector<EdgeRole> roles;
  for (const GraphEdge& edge : graph.edges)
    roles.push_back(edge.kind == GraphEdgeKind::Chain ? EdgeRole::Trusted : EdgeRole::Candidate);
  const RobustSolution<3> robust = relaxRobust(problem, roles, {});
  std::vector<double> weights;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    weights.push_back(robust.edges[e].weight);
    if (graph.edges[e].kind == GraphEdgeKind::Chain) continue;
    const bool kept = robust.edges[e].verdict == urban_nav_core::ClosureVerdict::Accepted;
    ++(graph.edges[e].wrong ? counts.wrong : counts.right);
    if (graph.edges[e].wrong && kept) ++counts.wrong_kept;
    if (!graph.edges[e].wrong && !kept) ++counts.right_lost;
  }
  return computeNees(graph, problem, robust.solution.poses, weights);
}

std::string timed(int poses, int closures) {
  const SimulatedGraph graph = drive(poses, closures, 1);
  const Problem<3> problem = std::get<Problem<3>>(makeProblem(graph, deadReckoning(graph)));
  const std::vector<Rigid<3>> relaxed = solve(problem, {}).poses;
  double largest = 0.0;
  const double seconds = measureSeconds(3, [&] {
    const Marginals<3> marginals(problem, relaxed);
    for (int i = 0; i < poses; ++i) largest = std::max(largest, marginals.ofPose(i).covariance(0, 0));
  });
  const Marginals<3> marginals(problem, relaxed);
  const double pair = measureSeconds(3, [&] { marginals.between(poses / 3, poses / 2); });
  return std::to_string(poses) + " poses with " + std::to_string(closures) + " closures: all marginals in " +
         cell(seconds, 3) + " s of one core, the covariance of one pair without an edge in " + cell(1e3 * pair, 1) +
         " ms.";
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--graphs"});
  const int graphs = asked.number("--graphs", 30);
  const urban_nav_core::ThreadLimit one(1);
  Nees plain{}, robust{};
  ClosureCounts counts;
  for (int number = 1; number <= graphs; ++number) {
    const SimulatedGraph graph = makeGraph(number);
    const Nees alone = computeNees(graph), among = neesAmongFalseOnes(graph, number, counts);
    for (std::size_t k = 0; k < kPlaces; ++k) {
      plain[k] += alone[k] / graphs;
      robust[k] += among[k] / graphs;
    }
  }
  BenchTable table({"share of the path", "mean NEES of " + std::to_string(graphs), "with false closures", "99 % band"},
                   argc, argv);
  const urban_nav_core::Band band = urban_nav_core::chiSquareMeanBand(6.0, graphs, 0.99);
  const auto marked = [&band](double mean) { return cell(mean, 2) + (band.contains(mean) ? "" : " (outside)"); };
  for (std::size_t k = 0; k < kPlaces; ++k)
    table.add({cell(0.1 * static_cast<double>(k + 1), 1), marked(plain[k]), marked(robust[k]),
               cell(band.low, 2) + "..." + cell(band.high, 2)});
  table.note("False closures: " + std::to_string(counts.wrong) + " among " + std::to_string(counts.right) +
             " true ones; " + std::to_string(counts.wrong_kept) + " kept, " + std::to_string(counts.right_lost) +
             " true ones lost.");
  for (const auto& [poses, closures] : {std::pair(20000, 200), std::pair(20000, 2000), std::pair(100000, 1000)})
    table.note(timed(poses, closures));
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
