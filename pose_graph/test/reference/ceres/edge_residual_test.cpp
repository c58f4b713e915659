// SPDX-License-Identifier: BSD-3-Clause
#include "ceres/edge_residual.hpp"

#include <Eigen/Cholesky>

#include "support/drawn.hpp"
#include "urban_nav_core/testing/numeric_jacobian.hpp"

namespace pose_graph::test {
namespace {

using urban_nav_core::testing::numericJacobian;

// At large residuals: the squared residual is the edge's cost, and both derivatives match moved poses.
template <Objective objective, int D>
void expectSquareAndDerivatives() {
  constexpr int kN = kTangentSize<D>;
  Dice dice(7);
  for (int draw = 0; draw < 20; ++draw) {
    Edge<D> edge;
    edge.Z = drawRigid<D>(dice, 2.0, 1.0);
    edge.information = drawInformation<D>(dice);
    const EdgeTerm<D> term = makeTerm(edge);
    const TangentMatrix<D> root = Eigen::LLT<TangentMatrix<D>>(edge.information).matrixU();
    const Rigid<D> from = drawRigid<D>(dice, 3.0, 1.0);
    const Rigid<D> to = from * edge.Z * drawRigid<D>(dice, 0.5, 0.4);
    const auto residual = edgeResidual<objective, D>(term, root, from, to);
    const double expected = edgeCost<objective, D>(term, from, to);
    EXPECT_NEAR(residual.r.squaredNorm(), expected, 1e-9 * (1.0 + expected));
    constexpr int kK = kResidualSize<objective, D>;
    const Tangent<D> none = Tangent<D>::Zero();
    const auto by_from = [&](const Tangent<D>& d) {
      return Eigen::Matrix<double, kK, 1>(edgeResidual<objective, D>(term, root, moved<D>(from, d), to).r);
    };
    const auto by_to = [&](const Tangent<D>& d) {
      return Eigen::Matrix<double, kK, 1>(edgeResidual<objective, D>(term, root, from, moved<D>(to, d)).r);
    };
    const double scale = 1.0 + root.norm();
    EXPECT_LT((numericJacobian<kK, kN>(by_from, none) - residual.J_from).norm(), 1e-5 * scale);
    EXPECT_LT((numericJacobian<kK, kN>(by_to, none) - residual.J_to).norm(), 1e-5 * scale);
  }
}

TEST(EdgeResidual, HasTheEdgesCostAndExactDerivatives) {
  expectSquareAndDerivatives<Objective::Geodesic, 2>();
  expectSquareAndDerivatives<Objective::Geodesic, 3>();
  expectSquareAndDerivatives<Objective::Chordal, 2>();
  expectSquareAndDerivatives<Objective::Chordal, 3>();
  expectSquareAndDerivatives<Objective::G2o, 2>();
  expectSquareAndDerivatives<Objective::G2o, 3>();
}

}  // namespace
}  // namespace pose_graph::test
