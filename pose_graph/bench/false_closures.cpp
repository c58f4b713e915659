// SPDX-License-Identifier: BSD-3-Clause
// Graphs with false closures, drawn by the definition of Vertigo's script (Suenderhauf, Protzel, IROS 2012): distance
// of the relaxed graph from the optimum without them, false ones accepted, true ones rejected, and time. One row per
// draw, or with --seeds one per graph: each kind of false closures with as many consecutive seeds, a tenth and half as
// many as true closures.
//   pose_graph-bench-false_closures [NAME or FILE.g2o...] [--seed N] [--percent N] [--seeds N]
//     [-o results/false_closures.json]
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "support/false_closures.hpp"
#include "support/program.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

// Requirements: error as a share of the extent, and a larger share for small graphs; share of false closures kept;
// share of true ones lost.
constexpr double kShareOff = 0.005, kShareOffSmall = 0.01, kSmallM = 30.0, kShareKept = 0.002, kShareLost = 0.02;

std::vector<PublicGraph> readGraphs(const std::vector<std::string>& names) {
  std::vector<PublicGraph> graphs;
  std::vector<std::string> known;
  for (const std::string& name : names) {
    if (std::filesystem::path(name).extension() != ".g2o") {
      known.push_back(name);
      continue;
    }
    const urban_nav_core::G2oGraph file = urban_nav_core::readG2o(name);
    graphs.push_back({std::filesystem::path(name).stem().string(),
                      file.dimension == 2 ? AnyProblem(pose_graph::makeProblem<2>(file, name).problem)
                                          : AnyProblem(pose_graph::makeProblem<3>(file, name).problem)});
  }
  if (graphs.empty() || !known.empty())
    for (PublicGraph& graph : publicGraphs(known)) graphs.push_back(std::move(graph));
  return graphs;
}

std::string of(std::size_t some, std::size_t all) { return std::to_string(some) + " of " + std::to_string(all); }

void addDraws(const PublicGraph& graph, int percent, std::uint64_t seed, BenchTable& table) {
  const CleanGraph clean(graph.problem);
  const auto row = [&](const FalseKind& kind, const std::string& name, int share) {
    const FalseOutcome seen = clean.with(kind, 0.01 * share, seed);
    table.add({graph.name, name, std::to_string(share) + " %", cell(seen.error_m, 3), of(seen.kept, seen.wrong),
               of(seen.lost, seen.closures), cell(seen.seconds / clean.plainSeconds(), 1)});
  };
  row(kFalseKinds[0], "none", 0);
  for (const FalseKind& kind : kFalseKinds) row(kind, kind.name, percent);
}

void addSums(const PublicGraph& graph, int seeds, std::uint64_t first, BenchTable& table) {
  const CleanGraph clean(graph.problem);
  const double limit = clean.extent() * (clean.extent() < kSmallM ? kShareOffSmall : kShareOff);
  std::size_t sets = 0, within = 0, wrong = 0, kept = 0, lost = 0;
  double worst = 0.0;
  std::vector<double> times;
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(seeds); ++seed)
    for (const FalseKind& kind : kFalseKinds)
      for (const double share : {0.1, 0.5}) {
        const FalseOutcome seen = clean.with(kind, share, seed);
        ++sets;
        within += seen.error_m <= limit &&
                  static_cast<double>(seen.kept) <= kShareKept * static_cast<double>(seen.wrong) &&
                  static_cast<double>(seen.lost) <= kShareLost * static_cast<double>(seen.closures);
        wrong += seen.wrong;
        kept += seen.kept;
        lost += seen.lost;
        worst = std::max(worst, seen.error_m);
        times.push_back(seen.seconds / clean.plainSeconds());
      }
  std::sort(times.begin(), times.end());
  const FalseOutcome none = clean.with(kFalseKinds[0], 0.0, first);
  table.add({graph.name, std::to_string(clean.closures()), of(within, sets), of(kept, wrong),
             of(lost, sets * clean.closures()), cell(worst, 3) + " (" + cell(limit, 3) + ")",
             cell(times[times.size() / 2], 1), of(none.lost, none.closures),
             cell(none.seconds / clean.plainSeconds(), 1)});
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--seed", "--percent", "--seeds"});
  const auto seed = static_cast<std::uint64_t>(asked.number("--seed", 101));
  const urban_nav_core::ThreadLimit one(1);
  if (asked.options.count("--seeds") > 0) {
    const int seeds = asked.number("--seeds", 1);
    BenchTable table({"graph", "closures", "sets within the limits", "wrong ones kept", "true ones lost",
                      "worst, m (limit)", "time, times plain", "lost without false ones", "time then"},
                     argc, argv);
    for (const PublicGraph& graph : readGraphs(asked.names)) addSums(graph, seeds, seed, table);
    table.note(
        "Sets: four kinds, a tenth and half as many as true ones, seeds " + std::to_string(seed) + " to " +
        std::to_string(seed + static_cast<std::uint64_t>(seeds) - 1) +
        ". Limits: 0.5 % of the extent from the optimum without them (1 % below 30 m), one in 500 of the wrong ones "
        "kept, 2 % of the true ones lost. Median times, one core.");
    return show(table, asked.output);
  }
  BenchTable table({"graph", "false closures", "of the true ones", "from the clean optimum, m", "wrong ones kept",
                    "true ones lost", "time, times plain"},
                   argc, argv);
  for (const PublicGraph& graph : readGraphs(asked.names)) addDraws(graph, asked.number("--percent", 50), seed, table);
  table.note("Drawn with seed " + std::to_string(seed) +
             ", one draw a row. One core, processor time; plain: the graph without false closures, every edge used as "
             "given.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
