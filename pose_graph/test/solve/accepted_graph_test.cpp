// SPDX-License-Identifier: BSD-3-Clause
#include "solve/accepted_graph.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "robust/evidence/variances.hpp"
#include "robust/generators/inner_selection.hpp"
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
  for (const double off : {0.01, 3.0}) {  // near, and so far that a new initial guess converges faster
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

// The marginals of all pairs joined by an edge yield the same sums.
template <int D>
void sharesUnknownsAsMarginalsDo() {
  Dice dice(10 + D);
  const Problem<D> problem = test::drawProblem<D>(dice, 40, 25, 0.05, 0.02);
  const std::vector<Rigid<D>> poses = solve(problem, {}).poses;
  const std::vector<EdgeRole> roles = rolesByNumbers(problem);
  std::vector<char> in, is_closure;
  std::vector<double> weights;
  double ranks = 0.0;
  for (std::size_t e = 0; e < roles.size(); ++e) {
    in.push_back(e % 11 != 10 || roles[e] != EdgeRole::Candidate);
    is_closure.push_back(roles[e] == EdgeRole::Candidate);
    weights.push_back(in[e] ? is_closure[e] ? 0.5 : 2.0 : 0.0);
    ranks += in[e] && is_closure[e] ? kTangentSize<D> : 0;
  }
  AcceptedGraph<D> accepted(problem);
  accepted.take(in, weights);
  ASSERT_TRUE(accepted.factor(poses));
  const auto closures = accepted.share(poses, is_closure);
  const VarianceComponents components = varianceComponents(problem, roles, weights, poses);
  const VarianceComponent &shift = components.of[1][0], &turn = components.of[1][1];
  EXPECT_NEAR(closures.cost, 0.5 * (shift.squares + turn.squares), 1e-6 * closures.cost);
  EXPECT_NEAR(ranks - closures.unknowns, shift.redundancy + turn.redundancy, 0.01 * ranks);
  ASSERT_TRUE(accepted.factor(poses));
  EXPECT_NEAR(accepted.share(poses, in).unknowns, kTangentSize<D> * accepted.unknowns(), 1e-6);
}
TEST(AcceptedGraph, SharesUnknownsAsMarginalsDoInThePlane) { sharesUnknownsAsMarginalsDo<2>(); }
TEST(AcceptedGraph, SharesUnknownsAsMarginalsDoInSpace) { sharesUnknownsAsMarginalsDo<3>(); }

TEST(AcceptedGraph, GoesOnOnlyWhereTheCostIsInReach) {
  const auto graph =
      urban_nav_core::testing::sphereGraph(6, 12, 10.0, urban_nav_core::testing::evenNoise(0.05, 0.02), 3);
  const Problem<3> problem = test::simulatedProblem<3>(graph, graph.truth);
  Dice dice(7);
  std::vector<Rigid<3>> begin = solve(problem, {}).poses;
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] = moved(begin[i], test::drawTangent<3>(dice, 0.5, 0.1));
  AcceptedGraph<3> accepted(problem);
  accepted.take(std::vector<char>(problem.edges.size(), 1));
  const auto costWithin = [&](double most) {
    std::vector<Rigid<3>> poses = begin;
    accepted.relax(poses, 50, 1e-9, false, most);
    return accepted.cost(poses);
  };
  const double least = costWithin(std::numeric_limits<double>::infinity());
  EXPECT_EQ(costWithin(1.001 * least), least);
  // Half of it is unreachable, which is detected before convergence to the last digit.
  EXPECT_GT(costWithin(0.5 * least), least);
  EXPECT_LT(costWithin(0.5 * least), 1.5 * least);
}

TEST(AcceptedGraph, IsTooDenseBeyondTheMostWorkAndNoVerdictIsGivenThen) {
  Dice dice(12);
  const Problem<2> problem = test::drawProblem<2>(dice, 60, 40, 0.05, 0.02);
  const std::vector<EdgeRole> roles = rolesByNumbers(problem);
  const std::vector<char> all(problem.edges.size(), 1);
  const double work = AcceptedGraph<2>(problem).work(all);
  for (const double share : {0.5, 2.0}) {
    AcceptedGraph<2> accepted(problem, share * work);
    accepted.take(all);
    EXPECT_EQ(accepted.isTooDense(), share < 1.0);
  }
  EXPECT_TRUE(selectEdges(problem, roles, 0.01 * work).is_too_dense);
  const SelectedEdges<2> within = selectEdges(problem, roles, 10.0 * work), unlimited = selectEdges(problem, roles);
  EXPECT_FALSE(within.is_too_dense);
  for (std::size_t e = 0; e < roles.size(); ++e) EXPECT_EQ(within.edges[e].verdict, unlimited.edges[e].verdict) << e;
}

}  // namespace
}  // namespace pose_graph
