// SPDX-License-Identifier: BSD-3-Clause
// The public graphs, from the file to the optimum, with each objective: remaining cost and time. Processor time on one
// core, without reading, so that other processes do not count.
//   pose_graph-bench-graphs [NAME...] [--peers FILE] [--runs N] [-o results/graphs.json]
// FILE: results of other programs on the same machine, CSV of `graph,peer,version,options,seconds,reached` (reached 1:
// ends at its own optimum).
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "pose_graph/solution.hpp"
#include "pose_graph_ceres/solve_by_ceres.hpp"
#include "support/cholmod_once.hpp"
#include "support/problems.hpp"
#include "support/program.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::CsvTable;
using urban_nav_core::testing::cell;

struct Found {
  double seconds = 0.0, cost = 0.0;
  std::size_t iterations = 0;
  std::string ending;
  double chordal = 0.0;  // cost by that objective, started from here
};

Found relaxed(const PublicGraph& graph, Objective objective, int runs) {
  SolveOptions options;
  options.objective = objective;
  return std::visit(
      [&](const auto& problem) {
        auto solution = solve(problem, options);
        Found found;
        found.seconds = measureSeconds(runs, [&] { solution = solve(problem, options); });
        found.cost = solution.cost;
        found.iterations = solution.iterations.size();
        found.ending = toString(solution.ending);
        auto onwards = problem;
        onwards.poses = solution.poses;
        SolveOptions chordal;
        chordal.objective = Objective::Chordal;
        chordal.start = Start::Vertices;
        found.chordal = solve(onwards, chordal).cost;
        return found;
      },
      graph.problem);
}

/// As above with Ceres, including problem setup; empty if it ends elsewhere.
std::string byCeres(const PublicGraph& graph, double best, int runs) {
  return std::visit(
      [&](const auto& problem) {
        double cost = 0.0;
        const double seconds = measureSeconds(runs, [&] { cost = solveByCeres(problem, {}).cost; });
        return cost <= best * (1.0 + 1e-6) ? cell(1e3 * seconds, seconds < 0.0995 ? 1 : 0) : "";
      },
      graph.problem);
}

/// Returns the relative excess of a cost over the best known one, as "1.2e-09".
std::string excess(double cost, double best) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0e", (cost - best) / best);
  return text;
}

std::string milliseconds(double seconds) { return cell(1e3 * seconds, seconds < 0.0995 ? 1 : 0); }

/// Returns the fastest peer that reached its optimum, as "0.30 s, GTSAM GN from chordal".
struct Peer {
  double seconds = INFINITY;
  std::string name;
};
Peer bestPeer(const CsvTable& peers, const std::string& graph) {
  Peer best;
  for (std::size_t row = 0; row < peers.rows(); ++row) {
    if (peers.text(row, peers.column("graph")) != graph || peers.integer(row, peers.column("reached")) != 1) continue;
    const double seconds = peers.number(row, peers.column("seconds"));
    if (seconds < best.seconds)
      best = {seconds, peers.text(row, peers.column("peer")) + ", " + peers.text(row, peers.column("options"))};
  }
  return best;
}

/// Returns "Peers: GTSAM 4.3a0; g2o ..." in the order of the file.
std::string versions(const CsvTable& peers) {
  std::vector<std::string> named;
  for (std::size_t row = 0; row < peers.rows(); ++row) {
    const std::string each = peers.text(row, peers.column("peer")) + " " + peers.text(row, peers.column("version"));
    if (std::find(named.begin(), named.end(), each) == named.end()) named.push_back(each);
  }
  std::string text = "Peers, each with its best options:";
  for (const std::string& each : named) text += (each == named.front() ? " " : "; ") + each;
  return text + ".";
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--peers", "--runs"});
  const int runs = asked.number("--runs", 5);
  const std::string file = asked.text("--peers", "");
  const CsvTable peers =
      file.empty() ? CsvTable::parse("graph,peer,version,options,seconds,reached\n", "") : CsvTable::read(file);
  const urban_nav_core::ThreadLimit one(1);

  urban_nav_core::testing::BenchTable table(
      {"graph", "poses, edges", "geodesic, ms", "steps", "best peer, ms", "best peer", "Ceres, ms", "CHOLMOD once, ms",
       "chordal, ms", "above the optimum", "g2o, ms", "above the optimum", "chordal from the geodesic"},
      argc, argv);
  for (const PublicGraph& graph : publicGraphs(asked.names)) {
    const Found geodesic = relaxed(graph, Objective::Geodesic, runs);
    const Found chordal = relaxed(graph, Objective::Chordal, runs);
    const Found g2o = relaxed(graph, Objective::G2o, runs);
    const double once = std::visit([&](const auto& problem) { return cholmodOnce(problem, runs); }, graph.problem);
    const Peer peer = bestPeer(peers, graph.name);
    const std::string size =
        std::visit([](const auto& p) { return std::to_string(p.poses.size()) + ", " + std::to_string(p.edges.size()); },
                   graph.problem);
    table.add({graph.name, size, milliseconds(geodesic.seconds), std::to_string(geodesic.iterations),
               std::isfinite(peer.seconds) ? milliseconds(peer.seconds) : "", peer.name,
               byCeres(graph, geodesic.cost, runs), milliseconds(once), milliseconds(chordal.seconds),
               excess(chordal.cost, graph.chordal), milliseconds(g2o.seconds), excess(g2o.cost, graph.g2o),
               excess(geodesic.chordal, graph.chordal)});
  }
  table.note(
      "One core, processor time, median of " + std::to_string(runs) +
      ", reading left out. CHOLMOD once: its ordering, analysis and factorisation of the Gauss-Newton matrix, once. "
      "Ceres: --solver ceres, with our residuals and derivatives, from the same start.");
  if (peers.rows() > 0) table.note(versions(peers));
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
