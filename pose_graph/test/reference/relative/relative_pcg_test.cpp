// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph_relative/relative_pcg.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "small_graph.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {
namespace {

using test::smallGraph;

template <int D>
double costOfPoses(const Problem<D>& problem, const std::vector<Rigid<D>>& poses) {
  return computeCost(problem, ChainState<D>{{}, poses});
}

// Reference: dense damped Gauss-Newton over the poses with numeric derivatives; shares only the residual with the chain
// solver.
template <int D>
double denseCost(const Problem<D>& problem) {
  constexpr Eigen::Index kD = kTangentSize<D>;
  std::vector<Rigid<D>> poses = problem.poses;
  const Eigen::MatrixXd W = test::computeWeights(problem);
  const auto residuals = [&problem](const std::vector<Rigid<D>>& at) {
    return test::computeResiduals(problem, ChainState<D>{{}, at});
  };
  const auto shifted = [](std::vector<Rigid<D>> at, const Eigen::VectorXd& step) {
    for (std::size_t i = 1; i < at.size(); ++i)
      at[i] = moved(at[i], Tangent<D>(step.segment<kD>(kD * static_cast<Eigen::Index>(i - 1))));
    return at;
  };
  const Eigen::Index size = kD * static_cast<Eigen::Index>(poses.size() - 1);
  double damping = 1e-6;
  for (int round = 0; round < 100; ++round) {
    const Eigen::VectorXd e = residuals(poses);
    Eigen::MatrixXd J(e.size(), size);
    constexpr double kH = 1e-6;
    for (Eigen::Index i = 0; i < size; ++i) {
      const Eigen::VectorXd unit = kH * Eigen::VectorXd::Unit(size, i);
      J.col(i) = (residuals(shifted(poses, unit)) - residuals(shifted(poses, Eigen::VectorXd(-unit)))) / (2.0 * kH);
    }
    Eigen::MatrixXd A = J.transpose() * W * J, step = -J.transpose() * (W * e);
    A.diagonal() *= 1.0 + damping;
    if (!urban_nav_core::solvePositiveDefiniteInPlace(A, step)) break;
    const auto next = shifted(poses, step);
    if (costOfPoses(problem, next) < costOfPoses(problem, poses)) {
      poses = next;
      damping *= 0.1;
    } else {
      damping = std::max(1e-6, 10.0 * damping);
    }
  }
  return costOfPoses(problem, poses);
}

template <int D>
void expectTheDenseMinimum(double metres, double radians) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Problem<D> problem = smallGraph<D>(14, 8, metres, radians, seed);
    const double dense = denseCost(problem);
    const RelativeSolution<D> relaxed = relaxRelative(problem);
    EXPECT_EQ(relaxed.ending, Ending::Converged);
    EXPECT_NEAR(relaxed.cost, dense, 1e-6 * dense) << "seed " << seed;
    EXPECT_NEAR(relaxed.cost, costOfPoses(problem, relaxed.poses), 1e-9 * dense);
    EXPECT_NEAR(relaxed.cost_before, costOfPoses(problem, problem.poses), 1e-9 * relaxed.cost_before);
    EXPECT_GT(relaxed.cost_before, relaxed.cost);
    for (std::size_t i = 1; i < relaxed.iterations.size(); ++i)
      EXPECT_LT(relaxed.iterations[i].cost, relaxed.iterations[i - 1].cost);
  }
}

TEST(RelativePcg, ReachesTheCostOfADenseMinimisationOverPoses) {
  expectTheDenseMinimum<2>(0.05, 0.05);
  expectTheDenseMinimum<3>(0.05, 0.05);
  expectTheDenseMinimum<2>(0.2, 0.15);
  expectTheDenseMinimum<3>(0.2, 0.15);
}

TEST(RelativePcg, CouplingChangesThePathAndNotTheResult) {
  const Problem<3> problem = smallGraph<3>(60, 30, 0.1, 0.05);
  RelativePcgOptions options;
  const RelativeSolution<3> all = relaxRelative(problem, options);
  for (const int coupled : {0, 5}) {
    options.coupled_closures = coupled;
    const RelativeSolution<3> some = relaxRelative(problem, options);
    EXPECT_NEAR(some.cost, all.cost, 1e-7 * all.cost);
    EXPECT_GT(some.products, all.products);
  }
}

template <int D>
void expectNoCostWithoutNoise() {
  const RelativeSolution<D> still = relaxRelative(smallGraph<D>(200, 20, 0.0, 0.0));
  EXPECT_LE(still.cost, 1e-16);
  EXPECT_EQ(still.ending, Ending::Converged);
  // The same minimum from a bent initial guess.
  Problem<D> bent = smallGraph<D>(200, 20, 0.0, 0.0);
  test::Draw<D> draw(8);
  const auto truth = bent.poses;
  ChainState<D> state = makeState(bent.poses);
  bent.poses = moved(state, test::drawIncrements<D>(draw, 199, 0.02)).poses;
  const RelativeSolution<D> relaxed = relaxRelative(bent);
  EXPECT_GT(relaxed.cost_before, 1.0);
  EXPECT_LE(relaxed.cost, 1e-12);
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_LE((relaxed.poses[i].t - truth[i].t).norm(), 1e-6);
}

TEST(RelativePcg, WithoutNoiseThereIsNoCost) {
  expectNoCostWithoutNoise<2>();
  expectNoCostWithoutNoise<3>();
}

TEST(RelativePcg, FewPosesAndNoClosures) {
  EXPECT_TRUE(relaxRelative(Problem<3>()).poses.empty());
  Problem<2> one;
  one.poses.push_back(test::Draw<2>(1).rigid(1.0, 1.0));
  EXPECT_EQ(relaxRelative(one).poses[0].t, one.poses[0].t);
  EXPECT_EQ(relaxRelative(one).cost, 0.0);

  Problem<3> two = smallGraph<3>(2, 0, 0.3, 0.3);
  two.poses[0] = test::Draw<3>(2).rigid(5.0, 1.0);
  two.poses[1] = two.poses[0] * test::Draw<3>(3).rigid(1.0, 0.5);
  const RelativeSolution<3> pair = relaxRelative(two);
  EXPECT_LE(pair.cost, 1e-12);
  const Rigid<3> expected = two.poses[0] * two.edges[0].Z;
  EXPECT_EQ(pair.poses[0].t, two.poses[0].t);
  EXPECT_LE((pair.poses[1].t - expected.t).norm() + (pair.poses[1].R - expected.R).norm(), 1e-6);

  const Problem<3> chain = smallGraph<3>(20, 0, 0.3, 0.3);
  EXPECT_NEAR(relaxRelative(chain).cost, denseCost(chain), 1e-6);
}

TEST(RelativePcg, UnknownDirectionsOfClosuresStayUnknown) {
  // A closure that measures only a distance along x: the rest of the loop stays at odometry.
  Problem<2> problem = smallGraph<2>(20, 0, 0.0, 0.0);
  for (Edge<2>& edge : problem.edges) edge.information = Eigen::Vector3d(1e4, 1e4, 1e6).asDiagonal();
  Edge<2> closure{0, 19, problem.poses[0].inverse() * problem.poses[19], Eigen::Matrix3d::Zero()};
  closure.information(0, 0) = 1e8;
  closure.Z.t += closure.Z.R * Eigen::Vector2d(0.1, 7.0);
  problem.edges.push_back(closure);
  const RelativeSolution<2> relaxed = relaxRelative(problem);
  const Rigid<2> E = closure.Z.inverse() * relaxed.poses[0].inverse() * relaxed.poses[19];
  EXPECT_NEAR(E.t.x(), 0.0, 1e-3);
  EXPECT_NEAR(E.t.y(), -7.0, 0.05);
}

TEST(RelativePcg, GivesTheSameBitsAgain) {
  const Problem<3> problem = smallGraph<3>(60, 30, 0.1, 0.05);
  const RelativeSolution<3> a = relaxRelative(problem), b = relaxRelative(problem);
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].t, b.poses[i].t);
    EXPECT_EQ(a.poses[i].R, b.poses[i].R);
  }
}

TEST(RelativePcg, StopsWhenAsked) {
  const Problem<3> problem = smallGraph<3>(60, 30, 0.3, 0.2);
  RelativePcgOptions options;
  int calls = 0;
  double seen = 0.0;
  options.progress = [&](int iteration, double cost) {
    EXPECT_EQ(iteration, ++calls);
    seen = cost;
    return calls < 2;
  };
  const RelativeSolution<3> stopped = relaxRelative(problem, options);
  EXPECT_EQ(stopped.ending, Ending::Stopped);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(stopped.cost, seen);
  options.progress = nullptr;
  options.iterations = 1;
  EXPECT_EQ(relaxRelative(problem, options).ending, Ending::Iterations);
}

TEST(RelativePcg, AnAtrociousStartNeverEndsWithoutANumber) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    Problem<3> problem = smallGraph<3>(40, 20, 0.1, 0.1, seed);
    test::Draw<3> draw(seed);
    for (Rigid<3>& pose : problem.poses) pose = draw.rigid(50.0, 2.0);
    const RelativeSolution<3> relaxed = relaxRelative(problem);
    EXPECT_TRUE(std::isfinite(relaxed.cost));
    EXPECT_LT(relaxed.cost, relaxed.cost_before);
    for (const Rigid<3>& pose : relaxed.poses) EXPECT_TRUE(pose.t.allFinite() && pose.R.allFinite());
  }
}

TEST(RelativePcg, AsASolverCountsEachEdgeByItsWeight) {
  const Problem<3> problem = smallGraph<3>(30, 6, 0.1, 0.05);
  std::vector<double> weights(problem.edges.size(), 1.0);
  weights.back() = 0.0;
  weights[weights.size() - 2] = 0.25;
  Problem<3> weighted = problem;
  weighted.edges.pop_back();
  weighted.edges.back().information *= 0.25;
  const RelativeSolution<3> expected = relaxRelative(weighted);
  const ReferenceSolver solver = relativeSolver();
  EXPECT_EQ(solver.name, "relative_pcg");
  const Solution<3> relaxed = solver.solve(problem, {}, weights);
  EXPECT_EQ(relaxed.cost, expected.cost);
  for (std::size_t i = 0; i < problem.poses.size(); ++i) EXPECT_EQ(relaxed.poses[i].t, expected.poses[i].t);
  EXPECT_NE(solver.solve(problem, {}, {}).cost, expected.cost);
  SolveOptions options;
  options.iterations = 1;
  EXPECT_EQ(solver.solve(problem, options, weights).ending, Ending::Iterations);
}

TEST(RelativePcg, RefusesBadInputByName) {
  Problem<3> problem = smallGraph<3>(6, 2, 0.1, 0.1);
  problem.edges[2].Z.t.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(relaxRelative(problem), urban_nav_core::UserError);
}

}  // namespace
}  // namespace pose_graph
