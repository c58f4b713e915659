// SPDX-License-Identifier: BSD-3-Clause
// Graphs that are wrong in other ways than by false closures among true ones: odometry and false closures alone, a step
// of odometry that slipped, information of the wrong scale, two sessions that few closures join. A row for each kind,
// of so many seeds: how far the relaxed graph lies from the right one, what was kept and lost, how often a warning is
// due.
//   pose_graph-bench-wrong_graphs [NAME...] [--seed N] [--seeds N] [-o results/wrong_graphs.json]
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "manifold/rotation.hpp"
#include "pose_graph/robust.hpp"
#include "support/false_closures.hpp"
#include "support/program.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::Dice;

constexpr double kSlipShare = 0.05, kSlipRad = 1.0;  // of the extent; about each axis

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

template <int D>
bool isStep(const Edge<D>& edge) {
  return edge.to == edge.from + 1;
}

/// A graph with what is wrong about it.
template <int D>
struct WrongGraph {
  Problem<D> problem;
  std::vector<Rigid<D>> right;  ///< poses
  std::vector<char> is_false;   ///< by edge
};

template <int D>
double longestSide(const std::vector<Rigid<D>>& poses) {
  auto low = poses.front().t, high = low;
  for (const Rigid<D>& pose : poses) {
    low = low.cwiseMin(pose.t).eval();
    high = high.cwiseMax(pose.t).eval();
  }
  return (high - low).maxCoeff();
}

template <int D>
WrongGraph<D> drawChain(const Problem<D>& clean, std::size_t wrong, Dice& dice) {
  WrongGraph<D> made;
  made.problem = clean;
  const std::size_t before = made.problem.edges.size();
  addFalse<D>(made.problem, kFalseKinds[0], wrong, dice);
  std::vector<Edge<D>> edges;
  for (std::size_t e = 0; e < made.problem.edges.size(); ++e)
    if (e >= before || isStep(made.problem.edges[e])) edges.push_back(made.problem.edges[e]);
  made.problem.edges = edges;
  for (const Edge<D>& edge : edges) made.is_false.push_back(!isStep(edge));
  Problem<D> alone = clean;
  alone.edges.clear();
  for (const Edge<D>& edge : edges)
    if (isStep(edge)) alone.edges.push_back(edge);
  made.right = solve(alone, {}).poses;
  return made;
}

template <int D>
WrongGraph<D> drawSlip(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum, Dice& dice) {
  WrongGraph<D> made{clean, optimum, std::vector<char>(clean.edges.size(), 0)};
  std::size_t e = 0;
  do {
    e = dice.below(clean.edges.size());
  } while (!isStep(clean.edges[e]));
  Eigen::Matrix<double, D, 1> shift;
  for (int i = 0; i < D; ++i) shift[i] = dice.normal();
  made.problem.edges[e].Z.t += kSlipShare * longestSide<D>(optimum) / shift.norm() * shift;
  RotationVector<D> turn = RotationVector<D>::Zero();
  for (int i = 0; i < rotation_size<D>; ++i) turn[i] = dice.uniform(-kSlipRad, kSlipRad);
  made.problem.edges[e].Z.R = made.problem.edges[e].Z.R * expRotation(turn);
  made.is_false[e] = 1;
  return made;
}

template <int D>
WrongGraph<D> scaleInformation(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum, double odometry,
                               double closures) {
  WrongGraph<D> made{clean, optimum, std::vector<char>(clean.edges.size(), 0)};
  for (Edge<D>& edge : made.problem.edges) edge.information *= isStep(edge) ? odometry : closures;
  return made;
}

template <int D>
WrongGraph<D> drawSessions(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum, std::size_t links,
                           std::size_t wrong, Dice& dice) {
  WrongGraph<D> made;
  made.problem.poses = clean.poses;
  made.right = optimum;
  const int half = static_cast<int>(clean.poses.size() / 2);
  std::vector<Edge<D>> between;
  for (const Edge<D>& edge : clean.edges) {
    if ((edge.from < half) == (edge.to < half)) made.problem.edges.push_back(edge);
    else if (!isStep(edge)) between.push_back(edge);
  }
  made.is_false.assign(made.problem.edges.size(), 0);
  for (std::size_t k = 0; k < std::min(links, between.size()); ++k) {
    made.problem.edges.push_back(between[k * between.size() / std::min(links, between.size())]);
    made.is_false.push_back(0);
  }
  for (std::size_t k = 0; k < wrong && !between.empty(); ++k) {
    Edge<D> edge = between.front();
    edge.from = static_cast<int>(dice.below(sz(half)));
    edge.to = half + static_cast<int>(dice.below(clean.poses.size() - sz(half)));
    for (int i = 0; i < D; ++i) edge.Z.t[i] = dice.uniform(-1.0, 1.0);
    RotationVector<D> turn;
    for (int i = 0; i < rotation_size<D>; ++i) turn[i] = dice.uniform(-1.5, 1.5);
    edge.Z.R = expRotation(turn);
    made.problem.edges.push_back(edge);
    made.is_false.push_back(1);
  }
  return made;
}

struct Sum {
  std::size_t false_edges = 0, kept = 0, closures = 0, lost = 0, undecided = 0;
  double worst = 0.0, seconds = 0.0;
};

template <int D>
void addOutcome(const WrongGraph<D>& wrong, Sum& sum) {
  RobustSolution<D> robust;
  sum.seconds += measureSeconds(1, [&] { robust = relaxSelected(wrong.problem, rolesByNumbers(wrong.problem), {}); });
  sum.worst = std::max(sum.worst, apart<D>(robust.solution.poses, wrong.right));
  sum.undecided += robust.selection.undecided;
  for (std::size_t e = 0; e < wrong.problem.edges.size(); ++e) {
    const bool rejected = robust.edges[e].verdict == urban_nav_core::ClosureVerdict::Rejected;
    sum.false_edges += wrong.is_false[e];
    sum.kept += wrong.is_false[e] && !rejected;
    if (wrong.is_false[e] || isStep(wrong.problem.edges[e])) continue;
    ++sum.closures;
    sum.lost += rejected;
  }
}

template <int D>
void addKinds(const std::string& name, const Problem<D>& clean, std::uint64_t first, int seeds, BenchTable& table) {
  const std::vector<Rigid<D>> optimum = solve(clean, {}).poses;
  const double extent = longestSide<D>(optimum);
  const auto row = [&](const std::string& kind, const std::function<WrongGraph<D>(Dice&)>& draw) {
    Sum sum;
    for (int s = 0; s < seeds; ++s) {
      Dice dice(first + static_cast<std::uint64_t>(s));
      addOutcome<D>(draw(dice), sum);
    }
    table.add({name, kind, cell(100.0 * sum.worst / extent, 2),
               std::to_string(sum.kept) + " of " + std::to_string(sum.false_edges),
               std::to_string(sum.lost) + " of " + std::to_string(sum.closures), cell(sum.seconds / seeds, 2),
               std::to_string(sum.undecided)});
  };
  row("odometry and 20 false ones", [&](Dice& dice) { return drawChain<D>(clean, 20, dice); });
  row("odometry and 100 false ones", [&](Dice& dice) { return drawChain<D>(clean, 100, dice); });
  row("a slipped step", [&](Dice& dice) { return drawSlip<D>(clean, optimum, dice); });
  row("odometry ten times too sure", [&](Dice&) { return scaleInformation<D>(clean, optimum, 100.0, 1.0); });
  row("closures ten times too sure", [&](Dice&) { return scaleInformation<D>(clean, optimum, 1.0, 100.0); });
  row("all ten times too sure", [&](Dice&) { return scaleInformation<D>(clean, optimum, 100.0, 100.0); });
  row("all ten times too modest", [&](Dice&) { return scaleInformation<D>(clean, optimum, 0.01, 0.01); });
  row("two sessions, 5 true and 20 false", [&](Dice& dice) { return drawSessions<D>(clean, optimum, 5, 20, dice); });
  row("two sessions, 21 true and 200 false",
      [&](Dice& dice) { return drawSessions<D>(clean, optimum, 21, 200, dice); });
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--seed", "--seeds"});
  const auto seed = static_cast<std::uint64_t>(asked.number("--seed", 1));
  const int seeds = asked.number("--seeds", 3);
  const urban_nav_core::ThreadLimit one(1);
  BenchTable table({"graph", "what is wrong", "from the right one, % of the extent, worst", "false ones kept",
                    "true closures lost", "time, s", "undecided"},
                   argc, argv);
  for (const PublicGraph& graph : publicGraphs(asked.names))
    std::visit([&](const auto& problem) { addKinds(graph.name, problem, seed, seeds, table); }, graph.problem);
  table.note("Seeds " + std::to_string(seed) + " to " + std::to_string(seed + static_cast<std::uint64_t>(seeds) - 1) +
             ". The right one: least squares of the graph as published; of odometry with false closures, odometry. One "
             "core, processor time.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
