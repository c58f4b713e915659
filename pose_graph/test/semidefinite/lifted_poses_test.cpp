// SPDX-License-Identifier: BSD-3-Clause
#include "semidefinite/lifted_poses.hpp"

#include <cmath>

#include "pose_graph/solution.hpp"
#include "support/drawn.hpp"
#include "support/rings.hpp"

namespace pose_graph::test {
namespace {

double chordalCost(const Problem<2>& problem, const std::vector<Rigid<2>>& poses) {
  return cost(problem, poses, Objective::Chordal);
}

TEST(LiftedPoses, UndoAKnot) {
  // No small motion lowers the cost of a ring with a full turn more than measured; its optimum is zero.
  for (const int rounds : {0, 2, 3}) {
    const Problem<2> knotted = ring(30, rounds);
    const auto poses = liftedPoses(knotted, knotted.poses, {});
    ASSERT_TRUE(poses);
    EXPECT_LT(chordalCost(knotted, *poses), 1e-4 * chordalCost(knotted, knotted.poses)) << rounds;
  }
}

template <int D>
void expectNearTheOptimumFromAnywhere() {
  Dice dice(5);
  for (int draw = 0; draw < 5; ++draw) {
    const Problem<D> problem = drawProblem<D>(dice, 60, 40, 0.1, 0.1);
    SolveOptions options;
    options.objective = Objective::Chordal;
    options.start = Start::Vertices;
    const double best = solve(problem, options).cost;  // the vertices are the truth
    std::vector<Rigid<D>> anywhere;
    for (std::size_t i = 0; i < problem.poses.size(); ++i) anywhere.push_back(drawRigid<D>(dice, 10.0, 2.0));
    const auto poses = liftedPoses(problem, anywhere, {});
    ASSERT_TRUE(poses);
    EXPECT_LT(cost(problem, *poses, Objective::Chordal), 1.01 * best);
    EXPECT_EQ((*poses)[0].R, anywhere[0].R);
    EXPECT_EQ((*poses)[0].t, anywhere[0].t);
    for (const Rigid<D>& pose : *poses) {
      EXPECT_NEAR(pose.R.determinant(), 1.0, 1e-9);
      EXPECT_LT((pose.R.transpose() * pose.R - Rotation<D>::Identity()).norm(), 1e-9);
    }
  }
}

TEST(LiftedPoses, AreNearTheOptimumFromAnywhere) {
  expectNearTheOptimumFromAnywhere<2>();
  expectNearTheOptimumFromAnywhere<3>();
}

TEST(LiftedPoses, LeaveFixedOnesWhereTheyAre) {
  Dice dice(6);
  for (int draw = 0; draw < 5; ++draw) {
    Problem<3> problem = drawProblem<3>(dice, 60, 40, 0.1, 0.1);
    problem.fixed = {7, 30};
    SolveOptions options;
    options.objective = Objective::Chordal;
    options.start = Start::Vertices;
    const double best = solve(problem, options).cost;
    std::vector<Rigid<3>> anywhere;
    for (std::size_t i = 0; i < problem.poses.size(); ++i)
      anywhere.push_back(i == 7 || i == 30 ? problem.poses[i] : drawRigid<3>(dice, 10.0, 2.0));
    const auto poses = liftedPoses(problem, anywhere, {});
    ASSERT_TRUE(poses);
    for (const std::size_t i : {7U, 30U}) {
      EXPECT_EQ((*poses)[i].R, problem.poses[i].R);
      EXPECT_EQ((*poses)[i].t, problem.poses[i].t);
    }
    options.objective = Objective::Chordal;
    Problem<3> near = problem;
    near.poses = *poses;
    EXPECT_LT(solve(near, options).cost, 1.001 * best);
  }
}

TEST(LiftedPoses, RespectComponentsAndWeights) {
  // Two rings joined only by an edge without weight: each keeps its first pose, and neither keeps its wrap-around.
  Problem<2> both = ring(24, 2);
  const Problem<2> other = ring(24, 1);
  for (const Rigid<2>& pose : other.poses) both.poses.push_back({pose.R, pose.t + Eigen::Vector2d(100.0, 0.0)});
  for (Edge<2> edge : other.edges) {
    edge.from += 24;
    edge.to += 24;
    both.edges.push_back(edge);
  }
  const auto apart = liftedPoses(both, both.poses, {});
  ASSERT_TRUE(apart);
  EXPECT_LT(chordalCost(both, *apart), 1e-4 * chordalCost(both, both.poses));
  EXPECT_EQ((*apart)[24].t, both.poses[24].t);
  std::vector<double> weights(both.edges.size(), 1.0);
  both.edges.push_back({3, 30, Rigid<2>(), 1e6 * TangentMatrix<2>::Identity()});
  weights.push_back(0.0);
  const auto joined = liftedPoses(both, both.poses, weights);
  ASSERT_TRUE(joined);
  EXPECT_LT(cost(both, *joined, Objective::Chordal, weights), 1e-3);
}

TEST(LiftedPoses, NumbersBeyondReasonMakeNoNan) {
  Dice dice(9);
  for (const double huge : {1e150, 1e200, 1e300}) {
    Problem<3> problem = drawProblem<3>(dice, 20, 10, 0.1, 0.1);
    problem.edges[7].Z.t *= huge;
    const auto poses = liftedPoses(problem, problem.poses, {});
    for (std::size_t i = 0; poses && i < poses->size(); ++i)
      EXPECT_TRUE((*poses)[i].R.allFinite() && (*poses)[i].t.allFinite());
  }
}

}  // namespace
}  // namespace pose_graph::test
