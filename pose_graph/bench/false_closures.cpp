// SPDX-License-Identifier: BSD-3-Clause
// Public graphs with false closures drawn anew, by the definition of Vertigo's script (Suenderhauf, Protzel, IROS 2012): how far the relaxed
// graph lies from the optimum without them, how many wrong ones were kept and true ones lost, and how long that takes.
//   pose_graph-bench-false_closures [NAME...] [--seed N] [--percent N] [-o results/false_closures.json]
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "manifold/rotation.hpp"
#include "pose_graph/robust.hpp"
#include "support/problems.hpp"
#include "support/program.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::Dice;

constexpr std::size_t kGroup = 10;
constexpr double kPlaceM = 0.3, kTurnRad = 10.0 * M_PI / 180.0;  // deviation of a false transform, each axis
constexpr double kRightM = 1.0, kRightRad = 0.35;                // nearer than this one is right by chance

template <int D>
Rigid<D> nearlyNothing(Dice& dice) {
  Rigid<D> T;
  for (int i = 0; i < D; ++i) T.t[i] = kPlaceM * dice.normal();
  RotationVector<D> turn;
  for (int i = 0; i < rotation_size<D>; ++i) turn[i] = kTurnRad * dice.normal();
  T.R = expRotation(turn);
  return T;
}

template <int D>
void addFalse(Problem<D>& problem, bool local, std::size_t group, std::size_t count, Dice& dice) {
  const TangentMatrix<D> information = std::find_if(problem.edges.begin(), problem.edges.end(), [](const Edge<D>& e) {
                                         return e.to != e.from + 1;
                                       })->information;
  const std::size_t last = problem.poses.size() - 1 - group;
  for (std::size_t added = 0; added < count; added += group) {
    std::size_t a = 0, b = 0;
    while (a == b) {
      a = dice.below(last + 1);
      b = local ? a + dice.below(std::min(last, a + 20) - a + 1) : dice.below(last + 1);
    }
    if (a > b) std::swap(a, b);
    if (b == a + 1) b = a + 2;
    const Rigid<D> Z = nearlyNothing<D>(dice);
    for (std::size_t k = 0; k < group; ++k)
      problem.edges.push_back({static_cast<int>(a + k), static_cast<int>(b + k), Z, information});
  }
}

/// Root mean square of positions after the best rigid motion (Umeyama without scale).
template <int D>
double apart(const std::vector<Rigid<D>>& a, const std::vector<Rigid<D>>& b) {
  Eigen::Matrix<double, D, 1> mean_a = Eigen::Matrix<double, D, 1>::Zero(), mean_b = mean_a;
  const double n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i].t / n;
    mean_b += b[i].t / n;
  }
  Eigen::Matrix<double, D, D> M = Eigen::Matrix<double, D, D>::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) M += (b[i].t - mean_b) * (a[i].t - mean_a).transpose();
  const Rotation<D> R = nearestRotation(M);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (R * (a[i].t - mean_a) - (b[i].t - mean_b)).squaredNorm();
  return std::sqrt(sum / n);
}

struct Outcome {
  double error_m = 0.0, seconds = 0.0;
  std::size_t wrong = 0, kept = 0, closures = 0, lost = 0;
};

template <int D>
Outcome outcomeOf(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum, bool local, std::size_t group,
                  int percent, std::uint64_t seed) {
  Outcome made;
  for (const Edge<D>& edge : clean.edges) made.closures += edge.to != edge.from + 1;
  Problem<D> problem = clean;
  Dice dice(seed);
  addFalse<D>(problem, local, group, made.closures * static_cast<std::size_t>(percent) / 100, dice);
  RobustSolution<D> robust;
  made.seconds = secondsOf(1, [&] { robust = relaxRobust(problem, rolesByNumbers(problem), {}); });
  made.error_m = apart<D>(robust.solution.poses, optimum);
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    const bool rejected = robust.edges[e].verdict == Verdict::Rejected;
    if (e < clean.edges.size()) {
      made.lost += rejected && edge.to != edge.from + 1;
      continue;
    }
    const Rigid<D> off = edge.Z.inverse() * (optimum[static_cast<std::size_t>(edge.from)].inverse() *
                                             optimum[static_cast<std::size_t>(edge.to)]);
    if (off.t.norm() <= kRightM && logRotation(off.R).norm() <= kRightRad) continue;
    ++made.wrong;
    made.kept += !rejected;
  }
  return made;
}

void addRows(const PublicGraph& graph, int percent, int seed, urban_nav_core::testing::BenchTable& table) {
  std::visit(
      [&](const auto& problem) {
        auto clean = solve(problem, SolveOptions());
        const double plain = secondsOf(3, [&] { clean = solve(problem, SolveOptions()); });
        const auto row = [&](const std::string& kind, bool local, std::size_t group, int share) {
          const Outcome outcome =
              outcomeOf(problem, clean.poses, local, group, share, static_cast<std::uint64_t>(seed));
          table.add({graph.name, kind, std::to_string(share) + " %", cell(outcome.error_m, 3),
                     std::to_string(outcome.kept) + " of " + std::to_string(outcome.wrong),
                     std::to_string(outcome.lost) + " of " + std::to_string(outcome.closures),
                     cell(outcome.seconds / plain, 1)});
        };
        row("none", false, 1, 0);
        for (const bool local : {false, true})
          for (const std::size_t group : {std::size_t{1}, kGroup})
            row(std::string(local ? "local" : "random") + (group > 1 ? ", in tens" : ""), local, group, percent);
      },
      graph.problem);
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = argumentsOf(argc, argv, {"--seed", "--percent"});
  const int seed = asked.number("--seed", 101), percent = asked.number("--percent", 50);
  const urban_nav_core::ThreadLimit one(1);
  urban_nav_core::testing::BenchTable table({"graph", "false closures", "of the true ones", "from the clean optimum, m",
                                             "wrong ones kept", "true ones lost", "time, times plain"},
                                            argc, argv);
  for (const PublicGraph& graph : publicGraphs(asked.names)) addRows(graph, percent, seed, table);
  table.note(
      "Drawn with seed " + std::to_string(seed) +
      ", one draw a row. One core, processor time; plain: the graph without false closures, every edge taken as it is.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
