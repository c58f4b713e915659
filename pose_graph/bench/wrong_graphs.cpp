// SPDX-License-Identifier: BSD-3-Clause
// Graphs that are wrong: false closures among true ones, odometry and false closures alone, a step of odometry that
// slipped, information of the wrong scale, two sessions that few closures join. A row for each kind, of so many seeds:
// how far the relaxed graph lies from the right one, what was kept and lost, in how many draws a warning was given, and
// in how many the result is wrong without one; these are named on stderr.
//   pose_graph-bench-wrong_graphs [NAME...] [--seed N] [--seeds N] [--kind PART_OF_ITS_NAME] [-o
//   results/wrong_graphs.json]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "manifold/rotation.hpp"
#include "pose_graph/robust.hpp"
#include "pose_graph/selection_warnings.hpp"
#include "support/false_closures.hpp"
#include "support/program.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::Dice;

// What calls for a warning: closures lost, or something false kept and the map this much of its extent off.
constexpr double kShareLost = 0.02, kShareOff = 0.01;
constexpr double kRightM = 1.0, kRightRad = 0.35;    // a closure nearer than this is right by chance
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
WrongGraph<D> drawFalse(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum, const FalseKind& kind,
                        double share, Dice& dice) {
  WrongGraph<D> made{clean, optimum, std::vector<char>(clean.edges.size(), 0)};
  const auto closures = std::count_if(clean.edges.begin(), clean.edges.end(), [](const auto& e) { return !isStep(e); });
  addFalse<D>(made.problem, kind, static_cast<std::size_t>(share * static_cast<double>(closures)), dice);
  for (std::size_t e = clean.edges.size(); e < made.problem.edges.size(); ++e) {
    const Edge<D>& edge = made.problem.edges[e];
    const Rigid<D> off = edge.Z.inverse() * (optimum[sz(edge.from)].inverse() * optimum[sz(edge.to)]);
    made.is_false.push_back(off.t.norm() > kRightM || logRotation(off.R).norm() > kRightRad);
  }
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
  std::size_t false_edges = 0, kept = 0, closures = 0, lost = 0, undecided = 0, warned = 0, silent = 0;
  double worst = 0.0, seconds = 0.0;
};

template <int D>
std::size_t countWarnings(const WrongGraph<D>& wrong, const RobustSolution<D>& robust) {
  FileProblem<D> file;
  file.problem = wrong.problem;
  file.roles = rolesByNumbers(wrong.problem);
  file.ids.resize(wrong.problem.poses.size());
  std::iota(file.ids.begin(), file.ids.end(), 0);
  file.edges.resize(wrong.problem.edges.size());
  std::iota(file.edges.begin(), file.edges.end(), 0);
  return selectionWarnings(
             file, robust,
             estimateScales(file.problem, file.roles, robust.edges, robust.solution.poses, robust.selection))
      .size();
}

template <int D>
void addOutcome(const WrongGraph<D>& wrong, const std::string& name, double extent, Sum& sum) {
  RobustSolution<D> robust;
  const double seconds =
      measureSeconds(1, [&] { robust = relaxSelected(wrong.problem, rolesByNumbers(wrong.problem), {}); });
  const double off = apart<D>(robust.solution.poses, wrong.right) / extent;
  std::size_t false_edges = 0, kept = 0, closures = 0, lost = 0;
  for (std::size_t e = 0; e < wrong.problem.edges.size(); ++e) {
    const bool rejected = robust.edges[e].verdict == urban_nav_core::ClosureVerdict::Rejected;
    false_edges += wrong.is_false[e];
    kept += wrong.is_false[e] && !rejected;
    if (wrong.is_false[e] || isStep(wrong.problem.edges[e])) continue;
    ++closures;
    lost += rejected;
  }
  const std::size_t warnings = countWarnings(wrong, robust);
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

/// Which draws to make.
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
  const auto row = [&](const std::string& kind, int seeds, const std::function<WrongGraph<D>(Dice&)>& draw) {
    if (kind.find(draws.only) == std::string::npos) return;
    Sum sum;
    for (int s = 0; s < seeds; ++s) {
      const std::uint64_t seed = draws.first + static_cast<std::uint64_t>(s);
      Dice dice(seed);
      addOutcome<D>(draw(dice), name + ", " + kind + ", seed " + std::to_string(seed), extent, sum);
    }
    table.add({name, kind, std::to_string(seeds), cell(100.0 * sum.worst, 2),
               std::to_string(sum.kept) + " of " + std::to_string(sum.false_edges),
               std::to_string(sum.lost) + " of " + std::to_string(sum.closures), cell(sum.seconds / seeds, 2),
               cell(sum.seconds / seeds / plain, 1), std::to_string(sum.undecided), std::to_string(sum.warned),
               std::to_string(sum.silent)});
  };
  const auto drawn = [&](const std::string& kind, const std::function<WrongGraph<D>(Dice&)>& draw) {
    row(kind, draws.seeds, draw);
  };
  const auto scaled = [&](const std::string& kind, double odometry, double closures) {
    row(kind, 1, [&](Dice&) { return scaleInformation<D>(clean, optimum, odometry, closures); });
  };
  row("nothing", 1, [&](Dice&) { return scaleInformation<D>(clean, optimum, 1.0, 1.0); });
  for (const FalseKind& kind : kFalseKinds)
    drawn(std::string("half as many false, ") + kind.name,
          [&](Dice& dice) { return drawFalse<D>(clean, optimum, kind, 0.5, dice); });
  drawn("as many false, random", [&](Dice& dice) { return drawFalse<D>(clean, optimum, kFalseKinds[0], 1.0, dice); });
  drawn("odometry and 20 false ones", [&](Dice& dice) { return drawChain<D>(clean, 20, dice); });
  drawn("odometry and 100 false ones", [&](Dice& dice) { return drawChain<D>(clean, 100, dice); });
  drawn("a slipped step", [&](Dice& dice) { return drawSlip<D>(clean, optimum, dice); });
  scaled("odometry ten times too sure", 100.0, 1.0);
  scaled("closures ten times too sure", 1.0, 100.0);
  scaled("all ten times too sure", 100.0, 100.0);
  scaled("all ten times too modest", 0.01, 0.01);
  drawn("two sessions, 5 true and 20 false", [&](Dice& dice) { return drawSessions<D>(clean, optimum, 5, 20, dice); });
  drawn("two sessions, 21 true and 200 false",
        [&](Dice& dice) { return drawSessions<D>(clean, optimum, 21, 200, dice); });
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
      ". The right one: least squares of the graph as published; of odometry with false closures, odometry. Wrong: "
      "more than 2 % of the true closures lost, or something false kept and more than 1 % of the extent off. One "
      "core, processor time; plain: the graph as published, every edge taken as it is.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
