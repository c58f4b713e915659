// SPDX-License-Identifier: BSD-3-Clause
#include "relative/linear_system.hpp"

#include <gtest/gtest.h>

#include "small_graph.hpp"

namespace pose_graph {
namespace {

using test::Draw;
using test::smallGraph;
using test::stacked;

template <int D>
void expectNormalEquations() {
  // Residuals of half a metre and forty degrees.
  const Problem<D> problem = smallGraph<D>(9, 5, 0.5, 0.7);
  const ChainState<D> state = makeState(problem.poses);
  const LinearSystem<D> system(problem, makeChain(problem), state);
  const Eigen::MatrixXd J = test::numericRows(problem, state), W = test::computeWeights(problem);
  const Eigen::VectorXd e = test::computeResiduals(problem, state);
  EXPECT_NEAR(system.cost(), e.dot(W * e), 1e-9 * system.cost());
  EXPECT_NEAR(system.cost(), computeCost(problem, state), 1e-9 * system.cost());
  const Eigen::VectorXd b = -J.transpose() * (W * e);
  EXPECT_LE((stacked<D>(system.b()) - b).norm(), 1e-7 * b.norm());
  const Eigen::MatrixXd A = J.transpose() * W * J;
  Draw<D> draw(2);
  Increments<D> product, scratch;
  for (int i = 0; i < 5; ++i) {
    const Increments<D> step = test::drawIncrements<D>(draw, 8);
    system.apply(0.0, step, product, scratch);
    const Eigen::VectorXd expected = A * stacked<D>(step);
    EXPECT_LE((stacked<D>(product) - expected).norm(), 1e-7 * expected.norm());
  }
}

TEST(LinearSystem, AgreesWithTheDenseNormalEquations) {
  expectNormalEquations<2>();
  expectNormalEquations<3>();
}

template <int D>
void expectTransposed() {
  const Problem<D> problem = smallGraph<D>(30, 5, 0.5, 0.7);
  const LinearSystem<D> system(problem, makeChain(problem), makeState(problem.poses));
  Draw<D> draw(4);
  const Increments<D> step = test::drawIncrements<D>(draw, 29), pull = test::drawIncrements<D>(draw, 30);
  Increments<D> x, force;
  system.sweep(step, x);
  system.sweepBack(pull, force);
  EXPECT_NEAR(x.cwiseProduct(pull).sum(), step.cwiseProduct(force).sum(), 1e-10);
}

TEST(LinearSystem, SweepingBackIsTheTransposedSweep) {
  expectTransposed<2>();
  expectTransposed<3>();
}

TEST(LinearSystem, DampingIsInUnitsOfTheChain) {
  Problem<3> problem = smallGraph<3>(9, 5, 0.1, 0.1);
  const ChainState<3> state = makeState(problem.poses);
  const LinearSystem<3> system(problem, makeChain(problem), state);
  std::vector<Edge<3>> chain_alone;
  for (const Edge<3>& edge : problem.edges)
    if (std::abs(edge.from - edge.to) == 1) chain_alone.push_back(edge);
  problem.edges = chain_alone;
  const LinearSystem<3> chain(problem, makeChain(problem), state);
  Draw<3> draw(6);
  const Increments<3> step = test::drawIncrements<3>(draw, 8);
  Increments<3> damped, plain, block, scratch;
  system.apply(0.3, step, damped, scratch);
  system.apply(0.0, step, plain, scratch);
  chain.apply(0.0, step, block, scratch);
  EXPECT_LE((damped - plain - 0.3 * block).norm(), 1e-12 * damped.norm());
}

TEST(LinearSystem, AStateIsItsPoses) {
  const Problem<3> problem = smallGraph<3>(50, 0, 0.1, 0.5);
  const ChainState<3> state = makeState(problem.poses);
  ASSERT_EQ(state.poses.size(), problem.poses.size());
  for (std::size_t i = 0; i < problem.poses.size(); ++i) {
    EXPECT_LE((state.poses[i].t - problem.poses[i].t).norm(), 1e-12);
    EXPECT_LE((state.poses[i].R - problem.poses[i].R).norm(), 1e-12);  // the given poses are plain products
  }
}

}  // namespace
}  // namespace pose_graph
