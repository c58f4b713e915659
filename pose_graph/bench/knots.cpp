// SPDX-License-Identifier: BSD-3-Clause
// Initial guesses with rotation wrap-arounds: no rotation at all, or rotations with errors of 90 deg (standard
// deviation about each axis). Of 20 seeds, each with its own measurement noise and guess, the number that reach the
// global optimum: the lowest cost found from the truth and from all guesses.
//   pose_graph-bench-knots [--seeds N] [-o results/knots.json]
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "pose_graph/solution.hpp"
#include "support/problems.hpp"
#include "support/program.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
namespace testing = urban_nav_core::testing;
using testing::Dice;
using testing::SimulatedGraph;
using urban_nav_core::Pose;

constexpr double kQuarterTurn = 1.5707963267948966;
constexpr int kDescent = 25;    // steps of the descent from the given guess; with a wrap-around it would not converge
constexpr double kSame = 1e-6;  // relative to the cost: same optimum

struct Shape {
  const char* name;
  std::function<SimulatedGraph(std::uint64_t seed)> make;
};

/// `sigma`: of the measurements, m and rad, along and about each axis.
std::vector<Shape> shapes(double sigma) {
  const auto noise = testing::evenNoise(sigma, sigma);
  return {{"sphere, 50 x 50", [=](std::uint64_t seed) { return testing::sphereGraph(50, 50, 50.0, noise, seed); }},
          {"grid, 8 x 8 x 8", [=](std::uint64_t seed) { return testing::gridGraph(8, 8, 8, 1.0, 0.5, noise, seed); }},
          {"planar grid, 40 x 40",
           [=](std::uint64_t seed) { return testing::planarGridGraph(40, 40, 1.0, 0.5, noise, seed); }},
          {"Manhattan, 3 500 poses",
           [=](std::uint64_t seed) { return testing::manhattanGraph(3500, 40, 0.6, noise, seed); }}};
}

struct Guess {
  const char* name;
  std::function<Pose(const Pose& truth, bool planar, Dice& dice)> make;
};

Pose turned(const Pose& truth, bool planar, Dice& dice) {
  Eigen::Vector3d phi = kQuarterTurn * dice.normals<3>();
  if (planar) phi.head<2>().setZero();
  const double angle = phi.norm();
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, phi / std::max(angle, 1e-300))) * truth.q(), truth.t()};
}

std::vector<Guess> guesses() {
  return {{"no rotation, at their places",
           [](const Pose& truth, bool, Dice&) { return Pose(Eigen::Quaterniond::Identity(), truth.t()); }},
          {"rotations off by 90 deg", turned}};
}

/// Lowest costs from the guess with default options, from the guess without a search for a better start, and from the
/// truth.
struct Costs {
  double found = 0.0, descended = 0.0, from_truth = 0.0, seconds = 0.0;
};

template <int D>
Costs computeCosts(const SimulatedGraph& graph, const std::vector<Pose>& guess) {
  const auto problem = std::get<Problem<D>>(makeProblem(graph, guess));
  const auto at_truth = std::get<Problem<D>>(makeProblem(graph, graph.truth));
  SolveOptions vertices;
  vertices.start = Start::Vertices;
  Costs costs;
  costs.seconds = measureSeconds(1, [&] { costs.found = solve(problem, {}).cost; });
  costs.from_truth = solve(at_truth, vertices).cost;
  vertices.iterations = kDescent;
  costs.descended = solve(problem, vertices).cost;
  return costs;
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--seeds"});
  const int seeds = asked.number("--seeds", 20);
  const urban_nav_core::ThreadLimit one(1);
  testing::BenchTable table({"graph", "noise, m and rad", "initial guess", "at the optimum", "worst above it",
                             "by 25 steps from the guess only", "ms"},
                            argc, argv);
  const auto addRows = [&](double sigma, const Shape& shape) {
    for (const Guess& guess : guesses()) {
      int reached = 0, descended = 0;
      double worst = 0.0, seconds = 0.0;
      for (int seed = 1; seed <= seeds; ++seed) {
        const SimulatedGraph graph = shape.make(static_cast<std::uint64_t>(seed));
        Dice dice(static_cast<std::uint64_t>(1000 + seed));
        std::vector<Pose> poses;
        for (const Pose& truth : graph.truth) poses.push_back(guess.make(truth, graph.planar, dice));
        const Costs costs = graph.planar ? computeCosts<2>(graph, poses) : computeCosts<3>(graph, poses);
        const double best = std::min({costs.found, costs.descended, costs.from_truth});
        reached += costs.found <= best * (1.0 + kSame);
        descended += costs.descended <= best * (1.0 + kSame);
        worst = std::max(worst, costs.found / best - 1.0);
        seconds += costs.seconds;
      }
      char excess[32];
      std::snprintf(excess, sizeof excess, "%.0e", worst);
      table.add({shape.name, testing::cell(sigma, 1), guess.name,
                 std::to_string(reached) + " of " + std::to_string(seeds), excess,
                 std::to_string(descended) + " of " + std::to_string(seeds), testing::cell(1e3 * seconds / seeds, 0)});
    }
  };
  for (const double sigma : {0.1, 0.3})
    for (const Shape& shape : shapes(sigma)) addRows(sigma, shape);
  table.note("Noise along and about each axis; poses 1 m apart (sphere: 6 m at the equator).");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
