// SPDX-License-Identifier: BSD-3-Clause
// Graphs with errors: false closures among true ones, odometry with false closures only, a slipped step of odometry,
// information of the wrong scale, two sessions with few closures. One row per kind, over several seeds: distance of the
// relaxed graph from the right one, closures accepted and rejected wrongly, number of draws with a warning, and number
// with a wrong result but no warning; the latter are named on stderr.
//   pose_graph-bench-wrong_graphs [NAME...] [--seed N] [--seeds N] [--kind PART_OF_ITS_NAME] [-o
//   results/wrong_graphs.json]
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "pose_graph/robust.hpp"
#include "support/false_closures.hpp"
#include "support/program.hpp"
#include "support/wrong_graphs.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::Dice;

// A warning is required if more than this share of closures is lost, or if something false is kept and the map is off
// by this share of its extent.
constexpr double kShareLost = 0.02, kShareOff = 0.01;

struct Sum {
  std::size_t false_edges = 0, kept = 0, closures = 0, lost = 0, undecided = 0, warned = 0, silent = 0;
  double worst = 0.0, seconds = 0.0;
};

template <int D>
void addOutcome(const WrongGraph<D>& wrong, const std::string& name, double extent, Sum& sum) {
  RobustSolution<D> robust;
  const double seconds =
      measureSeconds(1, [&] { robust = relaxSelected(wrong.problem, rolesByNumbers(wrong.problem), {}); });
  const double off = distanceFromRight(wrong, robust.solution.poses) / extent;
  std::size_t false_edges = 0, kept = 0, closures = 0, lost = 0;
  for (std::size_t e = 0; e < wrong.problem.edges.size(); ++e) {
    const bool rejected = robust.edges[e].verdict == urban_nav_core::ClosureVerdict::Rejected;
    false_edges += wrong.truth[e] == EdgeTruth::False;
    kept += wrong.truth[e] == EdgeTruth::False && !rejected;
    if (wrong.truth[e] != EdgeTruth::True || isStep(wrong.problem.edges[e])) continue;
    ++closures;
    lost += rejected;
  }
  const std::size_t warnings = countWarnings(wrong.problem, robust);
  const bool is_wrong =
      static_cast<double>(lost) > kShareLost * static_cast<double>(closures) || (kept > 0 && off > kShareOff);
  if (is_wrong)
    std::fprintf(stderr,
                 "%s: %.2f %% of the extent off, %zu of %zu false ones kept, %zu of %zu true ones lost, %zu "
                 "warnings, evidence %.1f, %.2f s\n",
                 name.c_str(), 100.0 * off, kept, false_edges, lost, closures, warnings, robust.selection.log_evidence,
                 seconds);
  sum.seconds += seconds;
  sum.worst = std::max(sum.worst, off);
  sum.undecided += robust.selection.undecided;
  sum.warned += warnings > 0;
  sum.silent += is_wrong && warnings == 0;
  sum.false_edges += false_edges;
  sum.kept += kept;
  sum.closures += closures;
  sum.lost += lost;
}

/// Draws to evaluate.
struct Draws {
  std::uint64_t first = 1;
  int seeds = 3;
  std::string only;  ///< part of a kind's name
};

template <int D>
void addKinds(const std::string& name, const Problem<D>& clean, const Draws& draws, BenchTable& table) {
  std::vector<Rigid<D>> optimum = solve(clean, {}).poses;
  const double plain = measureSeconds(3, [&] { optimum = solve(clean, {}).poses; });
  const double extent = longestSide<D>(optimum);
  for (const WrongKind<D>& kind : wrongKinds<D>(clean, optimum)) {
    if (kind.name.find(draws.only) == std::string::npos) continue;
    const int seeds = kind.is_drawn ? draws.seeds : 1;
    Sum sum;
    for (int s = 0; s < seeds; ++s) {
      const std::uint64_t seed = draws.first + static_cast<std::uint64_t>(s);
      Dice dice(seed);
      addOutcome<D>(kind.draw(dice), name + ", " + kind.name + ", seed " + std::to_string(seed), extent, sum);
    }
    table.add({name, kind.name, std::to_string(seeds), cell(100.0 * sum.worst, 2),
               std::to_string(sum.kept) + " of " + std::to_string(sum.false_edges),
               std::to_string(sum.lost) + " of " + std::to_string(sum.closures), cell(sum.seconds / seeds, 2),
               cell(sum.seconds / seeds / plain, 1), std::to_string(sum.undecided), std::to_string(sum.warned),
               std::to_string(sum.silent)});
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--seed", "--seeds", "--kind"});
  const Draws draws{static_cast<std::uint64_t>(asked.number("--seed", 1)), asked.number("--seeds", 3),
                    asked.text("--kind", "")};
  const urban_nav_core::ThreadLimit one(1);
  BenchTable table({"graph", "what is wrong", "draws", "from the right one, % of the extent, worst", "false ones kept",
                    "true closures lost", "time, s", "times plain", "undecided", "warned", "wrong without a warning"},
                   argc, argv);
  for (const PublicGraph& graph : publicGraphs(asked.names))
    std::visit([&](const auto& problem) { addKinds(graph.name, problem, draws, table); }, graph.problem);
  table.note(
      "Seeds from " + std::to_string(draws.first) +
      ". The right one: least squares of the graph as published; of odometry with false closures, odometry; of "
      "sessions without a true closure between them, each separately. Wrong: more than 2 % of the true closures lost, "
      "or "
      "something false kept and more than 1 % of the extent off. Drawn closures within 1 m and 20 deg of the right one "
      "count neither as false nor as true. One core, processor time; plain: the graph as published, every edge used "
      "as given.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
