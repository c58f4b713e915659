// SPDX-License-Identifier: BSD-3-Clause
// Effect of graph size with false closures: a city like city10000 (M. Kaess) with 250 000 poses, 77 000 true and 15 000
// false closures, and a town with a million poses, 6 000 closures and 20 % additional false ones. Processor time with
// rejection, and without rejection for the graph without false closures; growth of peak memory.
//   pose_graph-bench-robust_size [city] [town] [--poses N] [-o results/robust_size.json]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "pose_graph/robust.hpp"
#include "pose_graph/selection_warnings.hpp"
#include "support/false_closures.hpp"
#include "support/program.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/false_closures.hpp"
#include "urban_nav_core/testing/peak_memory.hpp"
#include "urban_nav_core/testing/street_graph.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::FalseClosures;
using urban_nav_core::testing::measureMemory;
using urban_nav_core::testing::SimulatedGraph;

// As in city10000: standard deviations of its information, crossings per pose; of the requirement: closures per pose.
constexpr double kCityM = 0.1414, kCityRad = 0.1, kCrossings = 1.14, kCityTrue = 0.308, kCityFalse = 0.06;
constexpr std::size_t kCityPoses = 250000, kTownPoses = 1000000;
constexpr double kTownClosures = 0.006, kTownFalse = 0.2;
constexpr std::uint64_t kSizeSeed = 1;

std::size_t times(std::size_t count, double share) {
  return static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
}

SimulatedGraph drawCity(std::size_t poses) {
  const auto noise = urban_nav_core::testing::evenNoise(kCityM, kCityRad);
  const auto side = static_cast<std::size_t>(std::sqrt(kCrossings * static_cast<double>(poses)));
  const auto draw = [&](double density) {
    return urban_nav_core::testing::manhattanGraph(poses, side, density, noise, kSizeSeed);
  };
  const double all = static_cast<double>(draw(1.0).edges.size() - (poses - 1));
  return draw(std::min(1.0, kCityTrue * static_cast<double>(poses) / all));
}

SimulatedGraph drawTown(std::size_t poses) {
  return urban_nav_core::testing::streetGraph(poses, times(poses, kTownClosures),
                                              urban_nav_core::testing::streetNoise(), kSizeSeed);
}

template <int D>
std::size_t countWarnings(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                          const RobustSolution<D>& robust) {
  FileProblem<D> file;
  file.problem = problem;
  file.roles = roles;
  file.ids.resize(problem.poses.size());
  std::iota(file.ids.begin(), file.ids.end(), 0);
  file.edges.resize(problem.edges.size());
  std::iota(file.edges.begin(), file.edges.end(), 0);
  const DeviationScales scales = estimateScales(problem, roles, robust.edges, robust.solution.poses, robust.selection);
  return selectionWarnings(file, robust, scales).size();
}

template <int D>
void addRow(BenchTable& table, const std::string& name, SimulatedGraph graph, std::size_t wrong) {
  const Problem<D> clean = std::get<Problem<D>>(makeProblem(graph, deadReckoning(graph)));
  Solution<D> plain;
  const double plain_seconds = measureSeconds(1, [&] { plain = solve(clean, {}); });
  std::fprintf(stderr, "%s: plain %.1f s\n", name.c_str(), plain_seconds);
  addFalseClosures(graph, FalseClosures::Random, wrong, kSizeSeed);
  const Problem<D> problem = std::get<Problem<D>>(makeProblem(graph, deadReckoning(graph)));
  const std::vector<EdgeRole> roles = rolesByNumbers(problem);
  RobustSolution<D> robust;
  double seconds = 0.0;
  const double bytes =
      measureMemory([&] { seconds = measureSeconds(1, [&] { robust = relaxSelected(problem, roles, {}); }); });
  std::size_t false_edges = 0, kept = 0, lost = 0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const bool rejected = robust.edges[e].verdict == urban_nav_core::ClosureVerdict::Rejected;
    false_edges += graph.edges[e].wrong;
    kept += graph.edges[e].wrong && !rejected;
    lost += !graph.edges[e].wrong && roles[e] == EdgeRole::Candidate && rejected;
  }
  const std::size_t closures = problem.edges.size() + 1 - problem.poses.size() - false_edges;
  table.add({name, std::to_string(problem.poses.size()), std::to_string(closures), std::to_string(false_edges),
             cell(plain_seconds, 2), cell(seconds, 2), cell(seconds / plain_seconds, 1), cell(1e-6 * bytes, 0),
             std::to_string(kept), std::to_string(lost), cell(apart<D>(robust.solution.poses, plain.poses), 3),
             std::to_string(countWarnings(problem, roles, robust))});
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--poses"});
  const auto wants = [&](const char* name) {
    return asked.names.empty() || std::find(asked.names.begin(), asked.names.end(), name) != asked.names.end();
  };
  const auto poses = [&](std::size_t all) {
    return static_cast<std::size_t>(asked.number("--poses", static_cast<int>(all)));
  };
  const urban_nav_core::ThreadLimit one(1);
  BenchTable table({"graph", "poses", "true closures", "false ones", "plain, s", "with rejection, s", "times plain",
                    "MB at the peak", "false ones kept", "true ones lost", "from the clean optimum, m", "warnings"},
                   argc, argv);
  if (wants("city")) {
    const std::size_t count = poses(kCityPoses);
    addRow<2>(table, "city", drawCity(count), times(count, kCityFalse));
  }
  if (wants("town")) {
    const std::size_t count = poses(kTownPoses);
    addRow<3>(table, "town", drawTown(count), times(count, kTownClosures * kTownFalse));
  }
  table.note(
      "One core, processor time, one run. Plain: without false closures, every edge used as given. Memory: "
      "growth by the relaxation, without the problem.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
