// SPDX-License-Identifier: BSD-3-Clause
#include "relative/preconditioner.hpp"

#include <gtest/gtest.h>

#include "small_graph.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph {
namespace {

using test::smallGraph;
using test::stacked;
using test::unstacked;

// Returns P as a matrix, column by column.
template <int D>
Eigen::MatrixXd toMatrix(const Preconditioner<D>& preconditioner, int links) {
  const Eigen::Index size = kTangentSize<D> * links;
  Eigen::MatrixXd P(size, size);
  Increments<D> result, scratch;
  for (Eigen::Index i = 0; i < size; ++i) {
    preconditioner.apply(unstacked<D>(Eigen::VectorXd::Unit(size, i)), result, scratch);
    P.col(i) = stacked<D>(result);
  }
  return P;
}

template <int D>
void expectInverse(double damping) {
  const Problem<D> problem = smallGraph<D>(12, 8, 0.5, 0.7);  // a third of the closures has singular information
  const LinearSystem<D> system(problem, makeChain(problem), makeState(problem.poses));
  const Eigen::MatrixXd P = toMatrix(Preconditioner<D>(system, damping, 8), 11);
  Increments<D> product, scratch;
  for (Eigen::Index i = 0; i < P.cols(); ++i) {
    system.apply(damping, unstacked<D>(P.col(i)), product, scratch);
    EXPECT_LE((stacked<D>(product) - Eigen::VectorXd::Unit(P.cols(), i)).norm(), 1e-9) << i;
  }
}

TEST(Preconditioner, WithAllClosuresIsTheInverse) {
  for (const double damping : {0.0, 0.5}) {
    expectInverse<2>(damping);
    expectInverse<3>(damping);
  }
}

template <int D>
void expectPositiveDefinite(int coupled) {
  const Problem<D> problem = smallGraph<D>(12, 8, 0.5, 0.7);
  const LinearSystem<D> system(problem, makeChain(problem), makeState(problem.poses));
  const Eigen::MatrixXd P = toMatrix(Preconditioner<D>(system, 0.0, coupled), 11);
  EXPECT_LE((P - P.transpose()).norm(), 1e-12 * P.norm());
  EXPECT_GT(urban_nav_core::symmetricEigenvalues(P)->minCoeff(), 0.0);
}

TEST(Preconditioner, IsSymmetricAndPositiveDefiniteWithAnyOfThem) {
  for (const int coupled : {0, 1, 3, 8, 100}) {
    expectPositiveDefinite<2>(coupled);
    expectPositiveDefinite<3>(coupled);
  }
}

TEST(Preconditioner, CouplesTheClosuresLeastConstrainedByTheChain) {
  // One closure over the whole chain and many over two links: including the long one must be what helps.
  Problem<2> problem = smallGraph<2>(40, 0, 0.0, 0.0);
  const auto add = [&problem](int from, int to) {
    const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
    problem.edges.push_back({from, to, problem.poses[a].inverse() * problem.poses[b]});
    problem.edges.back().information.setIdentity();
  };
  for (int i = 0; i < 30; i += 3) add(i, i + 2);
  add(0, 39);
  const LinearSystem<2> system(problem, makeChain(problem), makeState(problem.poses));
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(3 * 39, 40);
  const auto error = [&](int coupled) {
    Increments<2> result, product, scratch;
    Preconditioner<2>(system, 0.0, coupled).apply(unstacked<2>(unit), result, scratch);
    system.apply(0.0, result, product, scratch);
    return (stacked<2>(product) - unit).norm();
  };
  EXPECT_LT(error(1), 0.2 * error(0));
}

}  // namespace
}  // namespace pose_graph
