// SPDX-License-Identifier: BSD-3-Clause
#include "start/chordal_start.hpp"

#include "support/drawn.hpp"

namespace pose_graph::test {
namespace {

template <int D>
std::vector<Rotation<D>> toRotations(const std::vector<Rigid<D>>& poses) {
  std::vector<Rotation<D>> made;
  for (const Rigid<D>& pose : poses) made.push_back(pose.R);
  return made;
}

/// Returns the truth with every pose except the first displaced and rotated randomly.
template <int D>
Problem<D> withoutGuess(const Problem<D>& exact, Dice& dice) {
  Problem<D> made = exact;
  for (std::size_t i = 1; i < made.poses.size(); ++i) made.poses[i] = drawRigid<D>(dice, 50.0, 2.0);
  return made;
}

template <int D>
void expectExact() {
  Dice dice(1);
  const Problem<D> exact = drawProblem<D>(dice, 30, 15, 0.0, 0.0);
  const Problem<D> problem = withoutGuess(exact, dice);
  const NormalEquations<D> equations(problem);
  const auto rotations = chordalRotations(equations, problem.poses, {});
  ASSERT_TRUE(rotations);
  const auto poses = translationsFor(equations, *rotations, problem.poses, {});
  ASSERT_TRUE(poses);
  EXPECT_LT(largestDifference(*poses, exact.poses), 1e-8);
}
TEST(ChordalStart, ExactMeasurementsGiveThePosesFromAnyGuess) {
  expectExact<2>();
  expectExact<3>();
}

template <int D>
void expectRotations() {
  Dice dice(2);
  const Problem<D> problem = withoutGuess(drawProblem<D>(dice, 30, 25, 0.1, 0.4), dice);
  const NormalEquations<D> equations(problem);
  const auto rotations = chordalRotations(equations, problem.poses, {});
  ASSERT_TRUE(rotations);
  EXPECT_EQ((*rotations)[0], problem.poses[0].R);
  for (const Rotation<D>& R : *rotations) {
    EXPECT_LT((R * R.transpose() - Rotation<D>::Identity()).norm(), 1e-12);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  }
}
TEST(ChordalStart, GivesRotations) {
  expectRotations<2>();
  expectRotations<3>();
}

/// With the rotations given, no other translations have a lower cost.
template <int D>
void expectBestTranslations() {
  Dice dice(3);
  const Problem<D> problem = drawProblem<D>(dice, 15, 9, 0.3, 0.2);
  const NormalEquations<D> equations(problem);
  const auto rotations = toRotations(problem.poses);
  std::vector<double> weights;
  for (std::size_t e = 0; e < problem.edges.size(); ++e) weights.push_back(dice.uniform(0.5, 2.0));
  const auto computeCost = [&](const std::vector<Rigid<D>>& poses) {
    double total = 0.0;
    for (std::size_t e = 0; e < problem.edges.size(); ++e) {
      const Edge<D>& edge = problem.edges[e];
      const Rigid<D>&from = poses[static_cast<std::size_t>(edge.from)], &to = poses[static_cast<std::size_t>(edge.to)];
      const Eigen::Matrix<double, D, 1> error =
          edge.Z.R.transpose() * (from.R.transpose() * (to.t - from.t) - edge.Z.t);
      total += weights[e] * error.dot(edge.information.template topLeftCorner<D, D>() * error);
    }
    return total;
  };
  const auto best = translationsFor(equations, rotations, problem.poses, weights);
  ASSERT_TRUE(best);
  EXPECT_EQ((*best)[0].t, problem.poses[0].t);
  for (std::size_t i = 1; i < best->size(); ++i)
    for (int k = 0; k < D; ++k)
      for (const double h : {1e-3, -1e-3}) {
        auto other = *best;
        other[i].t[k] += h;
        EXPECT_GT(computeCost(other), computeCost(*best));
      }
}
TEST(ChordalStart, TranslationsAreTheBestOnes) {
  expectBestTranslations<2>();
  expectBestTranslations<3>();
}

template <int D>
void expectNothing() {
  Dice dice(4);
  Problem<D> problem = drawProblem<D>(dice, 6, 0, 0.0, 0.0);
  problem.edges.resize(5);
  const NormalEquations<D> equations(problem);
  std::vector<double> weights(5, 1.0);
  weights[3] = 0.0;
  EXPECT_FALSE(chordalRotations(equations, problem.poses, weights));
  EXPECT_FALSE(translationsFor(equations, toRotations(problem.poses), problem.poses, weights));
}
TEST(ChordalStart, IsEmptyWhereEdgesDetermineNothing) {
  expectNothing<2>();
  expectNothing<3>();
}

}  // namespace
}  // namespace pose_graph::test
