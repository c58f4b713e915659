// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/solution.hpp"
#include "support/dense_solution.hpp"
#include "support/drawn.hpp"
#include "support/held_graph.hpp"

namespace pose_graph::test {
namespace {

template <int D>
void expectDenseOptimum(Dice& dice, Held held, int count, Objective objective) {
  const Problem<D> problem = drawHeld<D>(dice, held, count);
  SolveOptions options;
  options.objective = objective;
  const Solution<D> solution = solve(problem, options);
  const DenseSolution<D> dense(problem, objective, solution.poses);
  EXPECT_EQ(solution.ending, Ending::Converged);
  EXPECT_LE(solution.cost, dense.cost * (1.0 + 1e-6) + 1e-12);
  EXPECT_LE(solution.iterations.size(), 10U);
  const DenseSolution<D> from_guess(problem, objective, problem.poses);
  EXPECT_LE(solution.cost, from_guess.cost * (1.0 + 1e-6) + 1e-12);
  for (const int pose : problem.fixed) {
    EXPECT_EQ(solution.poses[static_cast<std::size_t>(pose)].t, problem.poses[static_cast<std::size_t>(pose)].t);
    EXPECT_EQ(solution.poses[static_cast<std::size_t>(pose)].R, problem.poses[static_cast<std::size_t>(pose)].R);
  }
}

TEST(FixedPoses, EndAtTheDenseOptimum) {
  Dice dice(41);
  for (int draw = 0; draw < 5; ++draw)
    for (const Held held : kHeld)
      for (int count = held == Held::Nothing ? 0 : 1; count <= (held == Held::Nothing ? 0 : 3); ++count)
        for (const Objective objective : kObjectives) {
          SCOPED_TRACE(testing::Message() << "draw " << draw << ", held " << static_cast<int>(held) << ", " << count
                                          << ", objective " << static_cast<int>(objective));
          expectDenseOptimum<2>(dice, held, count, objective);
          expectDenseOptimum<3>(dice, held, count, objective);
        }
}

TEST(FixedPoses, OfUnconnectedPartsAreInOneFrame) {
  Dice dice(42);
  Problem<3> problem = drawHeld<3>(dice, Held::WherePosesAre, 1);
  const Problem<3> other = drawHeld<3>(dice, Held::WherePosesAre, 2);
  const int shift = static_cast<int>(problem.poses.size());
  problem.poses.insert(problem.poses.end(), other.poses.begin(), other.poses.end());
  for (Edge<3> edge : other.edges) {
    edge.from += shift;
    edge.to += shift;
    problem.edges.push_back(edge);
  }
  for (const int pose : other.fixed) problem.fixed.push_back(pose + shift);
  const Solution<3> solution = solve(problem, {}), alone = solve(other, {});
  EXPECT_EQ(solution.components, 1);
  const std::vector<Rigid<3>> second(solution.poses.begin() + shift, solution.poses.end());
  EXPECT_LT(largestDifference(second, alone.poses), 1e-6);
}

TEST(FixedPoses, EveryStartLeavesThemWhereTheyAre) {
  Dice dice(43);
  const Problem<2> problem = drawHeld<2>(dice, Held::WherePosesAre, 3);
  for (const Start start : {Start::Auto, Start::Vertices, Start::Odometry, Start::Identity}) {
    SolveOptions options;
    options.start = start;
    const Solution<2> solution = solve(problem, options);
    for (const int pose : problem.fixed)
      EXPECT_EQ(solution.poses[static_cast<std::size_t>(pose)].t, problem.poses[static_cast<std::size_t>(pose)].t);
  }
}

TEST(FixedPoses, AllOfThemLeaveNothingToRelax) {
  Dice dice(44);
  Problem<3> problem = drawHeld<3>(dice, Held::Nothing, 0);
  for (int i = 0; i < static_cast<int>(problem.poses.size()); ++i) problem.fixed.push_back(i);
  const Solution<3> solution = solve(problem, {});
  EXPECT_EQ(solution.ending, Ending::Converged);
  EXPECT_EQ(largestDifference(solution.poses, problem.poses), 0.0);
}

TEST(Ending, AtTheLimitStatesTheGradient) {
  Dice dice(45);
  const Problem<3> problem = drawProblem<3>(dice, 20, 12, 0.3, 0.3);
  for (const Objective objective : kObjectives) {
    SolveOptions options;
    options.objective = objective;
    options.start = Start::Vertices;
    options.iterations = 1;
    const Solution<3> solution = solve(problem, options);
    ASSERT_EQ(solution.ending, Ending::Iterations);
    Problem<3> there = problem;
    there.poses = solution.poses;
    DenseSolution<3> dense(there, objective, solution.poses, 0);
    EXPECT_NEAR(solution.gradient, dense.gradient().norm(), 1e-5 * solution.gradient);
    EXPECT_NE(endingWarning(solution.ending, 1, solution.gradient).find("gradient"), std::string::npos);
  }
  EXPECT_EQ(solve(problem, {}).gradient, 0.0);
  EXPECT_EQ(endingWarning(Ending::Converged, 3, 0.0), "");
  EXPECT_EQ(endingWarning(Ending::Stopped, 3, 0.0), "");
}

}  // namespace
}  // namespace pose_graph::test
