// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph_ceres/solve_by_ceres.hpp"

#include "support/drawn.hpp"

namespace pose_graph::test {
namespace {

template <int D>
void expectTheSameOptimum() {
  Dice dice(11);
  for (const Objective objective : {Objective::Geodesic, Objective::Chordal, Objective::G2o}) {
    Problem<D> problem = drawProblem<D>(dice, 60, 40, 0.05, 0.05);
    problem.edges.back().information.setZero();  // singular information is supported
    SolveOptions options;
    options.objective = objective;
    const Solution<D> ours = solve(problem, options), theirs = solveByCeres(problem, options);
    EXPECT_NEAR(theirs.cost, ours.cost, 1e-6 * ours.cost);
    EXPECT_EQ(theirs.ending, Ending::Converged);
    EXPECT_FALSE(theirs.iterations.empty());
    for (std::size_t i = 0; i < problem.poses.size(); ++i)
      EXPECT_LT((ours.poses[i].t - theirs.poses[i].t).norm(), 1e-2) << i;
  }
}

TEST(SolveByCeres, EndsAtTheSameOptimum) {
  expectTheSameOptimum<2>();
  expectTheSameOptimum<3>();
}

TEST(SolveByCeres, LeavesWeightlessEdgesAndOtherPartsAlone) {
  Dice dice(3);
  Problem<3> problem = drawProblem<3>(dice, 20, 10, 0.05, 0.05);
  const Problem<3> other = drawProblem<3>(dice, 10, 4, 0.05, 0.05);
  for (Edge<3> edge : other.edges) {
    edge.from += 20;
    edge.to += 20;
    problem.edges.push_back(edge);
  }
  problem.poses.insert(problem.poses.end(), other.poses.begin(), other.poses.end());
  std::vector<double> weights(problem.edges.size(), 1.0);
  weights[25] = 0.0;
  const Solution<3> ours = solve(problem, {}, weights), theirs = solveByCeres(problem, {}, weights);
  EXPECT_EQ(theirs.components, 2);
  EXPECT_NEAR(theirs.cost, ours.cost, 1e-6 * ours.cost);
  EXPECT_EQ(theirs.poses[20].t, problem.poses[20].t);
}

TEST(SolveByCeres, StopsWhenAsked) {
  Dice dice(5);
  const Problem<3> problem = drawProblem<3>(dice, 40, 20, 0.3, 0.3);
  SolveOptions options;
  options.start = Start::Odometry;
  options.tolerance = 0.0;
  int calls = 0;
  options.progress = [&calls](int, double) { return ++calls < 2; };
  const Solution<3> solution = solveByCeres(problem, options);
  EXPECT_EQ(solution.ending, Ending::Stopped);
  EXPECT_EQ(solution.iterations.size(), 2u);
}

}  // namespace
}  // namespace pose_graph::test
