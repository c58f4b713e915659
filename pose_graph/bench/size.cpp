// SPDX-License-Identifier: BSD-3-Clause
// Relaxation of drives through a town with revisits from raw odometry: the paper's size (50 000 poses, 300 closures)
// and up to twenty times as much; at the paper's size also by its own method. Processor time, growth of peak memory,
// and remaining error.
//   pose_graph-bench-size [--runs N] [--largest POSES] [-o results/size.json]
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "pose_graph/solution.hpp"
#include "pose_graph_relative/relative_pcg.hpp"
#include "support/problems.hpp"
#include "support/program.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/peak_memory.hpp"
#include "urban_nav_core/testing/street_graph.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::measureMemory;
using urban_nav_core::testing::SimulatedGraph;

constexpr std::pair<int, int> kSizes[] = {{50000, 300}, {100000, 500}, {200000, 1000}, {500000, 2500}, {1000000, 5000}};

/// Root mean square distance to the truth, m; the first poses coincide.
double offBy(const SimulatedGraph& graph, const std::vector<Rigid<3>>& poses) {
  const Rigid<3> T = Rigid<3>{graph.truth[0].R(), graph.truth[0].t()} * poses[0].inverse();
  double sum = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) sum += (T.R * poses[i].t + T.t - graph.truth[i].t()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(poses.size()));
}

/// One method on one graph. `best`: cost reached from the truth.
void addRow(BenchTable& table, const std::string& solver, const SimulatedGraph& graph, const Problem<3>& problem,
            double best, int runs, const std::function<Solution<3>()>& relax) {
  Solution<3> solution;
  const double bytes = measureMemory([&] { solution = relax(); });
  const double seconds = measureSeconds(runs, [&] { solution = relax(); });
  const double poses = static_cast<double>(problem.poses.size());
  char excess[32];
  std::snprintf(excess, sizeof excess, "%.0e", solution.cost / best - 1.0);
  table.add({cell(poses, 0), std::to_string(problem.edges.size() - problem.poses.size() + 1), solver, cell(seconds, 2),
             cell(1e6 * seconds / poses, 2), cell(1e-6 * bytes, 0), cell(bytes / poses, 0),
             std::to_string(solution.iterations.size()), toString(solution.ending), excess,
             cell(offBy(graph, problem.poses), 2), cell(offBy(graph, solution.poses), 3)});
}

void addSize(BenchTable& table, int poses, int closures, int runs) {
  const SimulatedGraph graph = urban_nav_core::testing::streetGraph(
      static_cast<std::size_t>(poses), static_cast<std::size_t>(closures), urban_nav_core::testing::streetNoise(), 1);
  Problem<3> problem = std::get<Problem<3>>(makeProblem(graph, graph.truth));
  SolveOptions from_truth;
  from_truth.start = Start::Vertices;
  const double best = solve(problem, from_truth).cost;
  problem = std::get<Problem<3>>(makeProblem(graph, deadReckoning(graph)));
  addRow(table, "default", graph, problem, best, runs, [&] { return solve(problem, {}); });
  if (poses == kSizes[0].first)
    addRow(table, "relative_pcg", graph, problem, best, 1, [&] { return Solution<3>(relaxRelative(problem)); });
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--runs", "--largest"});
  const int runs = asked.number("--runs", 3), largest = asked.number("--largest", 1000000);
  const urban_nav_core::ThreadLimit one(1);
  BenchTable table({"poses", "closures", "solver", "s", "us a pose", "MB at the peak", "bytes a pose", "steps", "end",
                    "above the cost from the truth", "odometry off, m rms", "relaxed off, m rms"},
                   argc, argv);
  for (const auto& [poses, closures] : kSizes)
    if (poses <= largest) addSize(table, poses, closures, runs);
  table.note("One core, processor time, median of " + std::to_string(runs) +
             ", from raw odometry. Memory: growth by the relaxation, without the problem.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
