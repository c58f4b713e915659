// SPDX-License-Identifier: BSD-3-Clause
#include "relative/conjugate_gradients.hpp"

#include <gtest/gtest.h>

#include "small_graph.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph {
namespace {

using test::smallGraph;
using test::stacked;

template <int D>
void expectDenseSolution(int coupled, double damping) {
  const Problem<D> problem = smallGraph<D>(15, 9, 0.5, 0.7);
  const ChainState<D> state = makeState(problem.poses);
  const Chain<D> chain = makeChain(problem);
  const LinearSystem<D> system(problem, chain, state);
  const Eigen::MatrixXd J = test::numericRows(problem, state), W = test::computeWeights(problem);
  const Eigen::VectorXd e = test::computeResiduals(problem, state);
  Eigen::MatrixXd A = J.transpose() * W * J;
  const Eigen::MatrixXd undamped = A;
  for (int i = 0; i < chain.links; ++i) {
    constexpr Eigen::Index kD = kTangentSize<D>;
    A.block<kD, kD>(kD * i, kD * i) += damping * system.blocks()[static_cast<std::size_t>(i)];
  }
  Eigen::MatrixXd dense = -J.transpose() * (W * e);
  const Eigen::VectorXd b = dense;
  ASSERT_TRUE(urban_nav_core::solvePositiveDefiniteInPlace(A, dense));
  const Preconditioner<D> preconditioner(system, damping, coupled);
  const PcgResult<D> solved = conjugateGradients(system, preconditioner, damping, 1e-10, 1000);
  EXPECT_LE((stacked<D>(solved.step) - dense).norm(), 1e-6 * dense.norm()) << coupled << " coupled";
  const Eigen::VectorXd step = dense;
  const double promise = b.dot(step) - 0.5 * step.dot(undamped * step);
  EXPECT_NEAR(solved.promise, promise, 1e-6 * promise);
  if (coupled >= 9) {
    EXPECT_LE(solved.iterations, 3);
  }
}

TEST(ConjugateGradients, AgreeWithTheDenseSolution) {
  for (const int coupled : {0, 4, 9}) {
    for (const double damping : {0.0, 0.5}) {
      expectDenseSolution<2>(coupled, damping);
      expectDenseSolution<3>(coupled, damping);
    }
  }
}

TEST(ConjugateGradients, EndWhereTheyAreAsked) {
  const Problem<3> problem = smallGraph<3>(40, 20, 0.1, 0.1);
  const LinearSystem<3> system(problem, makeChain(problem), makeState(problem.poses));
  const Preconditioner<3> preconditioner(system, 0.0, 0);
  EXPECT_EQ(conjugateGradients(system, preconditioner, 0.0, 0.0, 7).iterations, 7);
  const int rough = conjugateGradients(system, preconditioner, 0.0, 1e-1, 1000).iterations;
  const int fine = conjugateGradients(system, preconditioner, 0.0, 1e-6, 1000).iterations;
  EXPECT_GT(rough, 0);
  EXPECT_GT(fine, rough);
}

TEST(ConjugateGradients, EveryStepPredictsALargerDecrease) {
  const Problem<3> problem = smallGraph<3>(40, 20, 0.5, 0.5);
  const LinearSystem<3> system(problem, makeChain(problem), makeState(problem.poses));
  const Preconditioner<3> preconditioner(system, 0.0, 0);
  double last = 0.0;
  for (int i = 1; i < 12; ++i) {
    const double promise = conjugateGradients(system, preconditioner, 0.0, 0.0, i).promise;
    EXPECT_GT(promise, last) << i;
    last = promise;
  }
}

}  // namespace
}  // namespace pose_graph
