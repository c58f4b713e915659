// SPDX-License-Identifier: BSD-3-Clause
#include "robust/accepted_graph.hpp"

#include <gtest/gtest.h>

#include "support/drawn.hpp"

namespace pose_graph {
namespace {

using test::Dice;

template <int D>
void settlesWhereTheSolverDoes() {
  const auto graph =
      urban_nav_core::testing::sphereGraph(6, 12, 10.0, urban_nav_core::testing::evenNoise(0.05, 0.02), 3);
  const auto flat =
      urban_nav_core::testing::manhattanGraph(200, 8, 0.5, urban_nav_core::testing::evenNoise(0.05, 0.02), 3);
  const auto& drawn = D == 3 ? graph : flat;
  Problem<D> problem = test::simulatedProblem<D>(drawn, drawn.truth);
  const Solution<D> solution = solve(problem, {});
  for (const double off : {0.01, 3.0}) {  // near, and so far that the way from there is the longer one
    Dice dice(D);
    std::vector<Rigid<D>> poses = solution.poses;
    for (std::size_t i = 1; i < poses.size(); ++i)
      poses[i] = moved(poses[i], test::drawTangent<D>(dice, 10.0 * off, off));
    AcceptedGraph<D> accepted(problem);
    accepted.take(std::vector<char>(problem.edges.size(), 1));
    accepted.settle(poses);
    EXPECT_LT(accepted.cost(poses), solution.cost * (1.0 + 1e-6)) << off;
  }
}
TEST(AcceptedGraph, SettlesWhereTheSolverDoesInThePlane) { settlesWhereTheSolverDoes<2>(); }
TEST(AcceptedGraph, SettlesWhereTheSolverDoesInSpace) { settlesWhereTheSolverDoes<3>(); }

}  // namespace
}  // namespace pose_graph
