// SPDX-License-Identifier: BSD-3-Clause
#include "objective/objective.hpp"

#include "support/drawn.hpp"
#include "support/plain_costs.hpp"
#include "urban_nav_core/testing/numeric_jacobian.hpp"

namespace pose_graph::test {
namespace {

using urban_nav_core::testing::numericJacobian;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

template <int D>
EdgeQuadratic<D> makeQuadratic(Objective objective, const Edge<D>& edge, const Rigid<D>& from, const Rigid<D>& to) {
  const EdgeTerm<D> term = makeTerm(edge);
  switch (objective) {
    case Objective::Geodesic: return edgeQuadratic<Objective::Geodesic, D>(term, from, to);
    case Objective::Chordal: return edgeQuadratic<Objective::Chordal, D>(term, from, to);
    case Objective::G2o: return edgeQuadratic<Objective::G2o, D>(term, from, to);
  }
  return {};
}

template <int D>
double computeCost(Objective objective, const Edge<D>& edge, const Rigid<D>& from, const Rigid<D>& to) {
  const EdgeTerm<D> term = makeTerm(edge);
  switch (objective) {
    case Objective::Geodesic: return edgeCost<Objective::Geodesic, D>(term, from, to);
    case Objective::Chordal: return edgeCost<Objective::Chordal, D>(term, from, to);
    case Objective::G2o: return edgeCost<Objective::G2o, D>(term, from, to);
  }
  return 0.0;
}

/// An edge and its two poses, with an error of `metres` and `angle`.
template <int D>
struct Case {
  Edge<D> edge;
  Rigid<D> from, to;

  Case(Dice& dice, double metres, double angle) : from(drawRigid<D>(dice, 3.0, 1.5)) {
    edge.Z = drawRigid<D>(dice, 2.0, 1.0);
    edge.information = drawInformation<D>(dice);
    Tangent<D> error = drawTangent<D>(dice, 1.0, 1.0);
    error.template head<D>() *= metres / error.template head<D>().norm();
    error.template tail<kRotationSize<D>>() *= angle / error.template tail<kRotationSize<D>>().norm();
    to = from * edge.Z * moved(Rigid<D>(), error);
  }
};

template <int D>
struct Sizes {
  static constexpr double kMetres[] = {0.0, 0.01, 0.5, 0.5, 2.0};
  static constexpr double kAngle[] = {0.0, 0.01, 40 * kDegree, 170 * kDegree, 100 * kDegree};
};

template <int D>
void expectCostsAsDefined() {
  Dice dice(1);
  for (int run = 0; run < 40; ++run) {
    const Case<D> one(dice, 2.0 * dice.uniform(), 179 * kDegree * dice.uniform());
    for (const Objective objective : kObjectives) {
      const double expected = plainResidual(objective, one.edge, one.from, one.to).cost();
      EXPECT_NEAR(computeCost(objective, one.edge, one.from, one.to), expected, 1e-11 * (1.0 + expected));
      EXPECT_NEAR(makeQuadratic(objective, one.edge, one.from, one.to).cost, expected, 1e-11 * (1.0 + expected));
    }
  }
}
TEST(Objective, CostsAreThoseOfTheDefinitions) {
  expectCostsAsDefined<2>();
  expectCostsAsDefined<3>();
}

/// The derivatives by `from` as NormalEquations computes them: T of EdgeQuadratic.
template <int D>
TangentMatrix<D> fromTo(const EdgeQuadratic<D>& quadratic) {
  TangentMatrix<D> T = TangentMatrix<D>::Identity();
  T.template topRightCorner<D, kRotationSize<D>>() = turned(quadratic.d);
  return T;
}

template <int D>
void expectGradients() {
  constexpr int kN = kTangentSize<D>;
  Dice dice(2);
  for (int size = 0; size < 5; ++size) {
    for (int run = 0; run < 8; ++run) {
      const Case<D> one(dice, Sizes<D>::kMetres[size], Sizes<D>::kAngle[size]);
      for (const Objective objective : kObjectives) {
        const EdgeQuadratic<D> quadratic = makeQuadratic(objective, one.edge, one.from, one.to);
        const Tangent<D> zero = Tangent<D>::Zero();
        const Tangent<D> by_to =
            numericJacobian<1, kN>(
                [&](const Tangent<D>& x) { return computeCost(objective, one.edge, one.from, moved(one.to, x)); }, zero)
                .transpose();
        const Tangent<D> by_from =
            numericJacobian<1, kN>(
                [&](const Tangent<D>& x) { return computeCost(objective, one.edge, moved(one.from, x), one.to); }, zero)
                .transpose();
        const double scale = 1.0 + by_to.norm() + by_from.norm();
        EXPECT_LT((2.0 * quadratic.g_to - by_to).norm(), 1e-8 * scale);
        EXPECT_LT((-2.0 * fromTo(quadratic).transpose() * quadratic.g_to - by_from).norm(), 1e-8 * scale);
      }
    }
  }
}
TEST(Objective, GradientsHoldAtLargeErrors) {
  expectGradients<2>();
  expectGradients<3>();
}

template <int D>
void expectGaussNewton() {
  constexpr int kN = kTangentSize<D>;
  Dice dice(3);
  for (int size = 0; size < 5; ++size) {
    const Case<D> one(dice, Sizes<D>::kMetres[size], Sizes<D>::kAngle[size]);
    for (const Objective objective : kObjectives) {
      constexpr int kMost = D * D + D;
      using Residual = Eigen::Matrix<double, kMost, 1>;  // padded with zeros
      const auto residual = [&](const Rigid<D>& from, const Rigid<D>& to) {
        const Eigen::VectorXd r = plainResidual(objective, one.edge, from, to).r;
        Residual made = Residual::Zero();
        made.head(r.size()) = r;
        return made;
      };
      const Tangent<D> zero = Tangent<D>::Zero();
      const Eigen::Matrix<double, kMost, kN> J_to =
          numericJacobian<kMost, kN>([&](const Tangent<D>& x) { return residual(one.from, moved(one.to, x)); }, zero);
      const Eigen::Matrix<double, kMost, kN> J_from =
          numericJacobian<kMost, kN>([&](const Tangent<D>& x) { return residual(moved(one.from, x), one.to); }, zero);
      const Eigen::MatrixXd small = plainResidual(objective, one.edge, one.from, one.to).W;
      Eigen::MatrixXd W = Eigen::MatrixXd::Zero(kMost, kMost);
      W.topLeftCorner(small.rows(), small.cols()) = small;

      const EdgeQuadratic<D> quadratic = makeQuadratic(objective, one.edge, one.from, one.to);
      const TangentMatrix<D> T = fromTo(quadratic), &K = quadratic.K;
      const double tolerance = 1e-7 * (1.0 + K.norm() + T.norm() * T.norm() * K.norm());
      EXPECT_LT((K - J_to.transpose() * W * J_to).norm(), tolerance) << "size " << size;
      EXPECT_LT((-T.transpose() * K - J_from.transpose() * W * J_to).norm(), tolerance) << "size " << size;
      EXPECT_LT((T.transpose() * K * T - J_from.transpose() * W * J_from).norm(), tolerance) << "size " << size;
    }
  }
}
TEST(Objective, MatrixIsThatOfGaussAndNewtonAtAnySize) {
  expectGaussNewton<2>();
  expectGaussNewton<3>();
}

template <int D>
void expectInvariance() {
  Dice dice(4);
  for (int run = 0; run < 20; ++run) {
    const Case<D> one(dice, 1.0, 2.0);
    const Rigid<D> T = drawRigid<D>(dice, 10.0, 2.0);
    for (const Objective objective : kObjectives) {
      const double before = computeCost(objective, one.edge, one.from, one.to);
      EXPECT_NEAR(computeCost(objective, one.edge, T * one.from, T * one.to), before, 1e-11 * before);
    }
  }
}
TEST(Objective, DoesNotChangeWhenBothPosesMoveAsOneBody) {
  expectInvariance<2>();
  expectInvariance<3>();
}

template <int D>
void expectSingularInformation() {
  Dice dice(5);
  for (int rank = 0; rank < kTangentSize<D>; ++rank) {
    Case<D> one(dice, 0.5, 1.0);
    one.edge.information = drawInformation<D>(dice, rank);
    const EdgeTerm<D> term = makeTerm(one.edge);
    EXPECT_TRUE(std::isfinite(term.kappa) && term.kappa >= 0.0);
    EXPECT_TRUE(std::isfinite(term.tau) && term.tau >= 0.0);
    if (rank < D) {
      EXPECT_LT(term.tau, 1e-12);
    }
    for (const Objective objective : kObjectives) {
      const EdgeQuadratic<D> quadratic = makeQuadratic(objective, one.edge, one.from, one.to);
      EXPECT_TRUE(std::isfinite(quadratic.cost) && quadratic.g_to.allFinite() && quadratic.K.allFinite());
      EXPECT_GE(quadratic.cost, 0.0);
    }
  }
}
TEST(Objective, TakesSingularInformation) {
  expectSingularInformation<2>();
  expectSingularInformation<3>();
}

TEST(Objective, TauOfFreeDirectionsIsTheLimit) {
  Edge<2> edge;
  for (const double weak : {1e-3, 1e-6, 1e-9}) {
    edge.information.diagonal() << 4.0, weak, 1.0;
    EXPECT_NEAR(makeTerm(edge).tau, 2.0 * weak, 1e-3 * weak);
  }
  edge.information.diagonal() << 4.0, 0.0, 1.0;
  EXPECT_EQ(makeTerm(edge).tau, 0.0);
}

TEST(Objective, HalfATurnIsNoTrouble) {
  const double half = 180 * kDegree;
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, -2, 3)}) {
    Edge<3> edge;
    const Rigid<3> from, to{expRotation(Eigen::Vector3d(half * axis.normalized())), Eigen::Vector3d(1, 2, 3)};
    for (const Objective objective : kObjectives) {
      const EdgeQuadratic<3> quadratic = makeQuadratic(objective, edge, from, to);
      EXPECT_TRUE(std::isfinite(quadratic.cost) && quadratic.g_to.allFinite() && quadratic.K.allFinite());
    }
    EXPECT_NEAR(computeCost(Objective::Geodesic, edge, from, to), 14.0 + half * half, 1e-9);
    EXPECT_NEAR(computeCost(Objective::G2o, edge, from, to), 14.0 + 4.0, 1e-9);
  }
  Rigid<3> exact;  // exactly half a turn
  for (int axis = 0; axis < 3; ++axis) {
    exact.R = -Eigen::Matrix3d::Identity();
    exact.R(axis, axis) = 1.0;
    for (const Objective objective : kObjectives) {
      const EdgeQuadratic<3> quadratic = makeQuadratic(objective, Edge<3>(), Rigid<3>(), exact);
      EXPECT_TRUE(std::isfinite(quadratic.cost) && quadratic.g_to.allFinite() && quadratic.K.allFinite());
    }
    EXPECT_NEAR(computeCost(Objective::Geodesic, Edge<3>(), Rigid<3>(), exact), half * half, 1e-9);
  }
  const Rigid<2> turned_about{-Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero()};
  for (const Objective objective : kObjectives)
    EXPECT_TRUE(makeQuadratic(objective, Edge<2>(), Rigid<2>(), turned_about).g_to.allFinite());
  EXPECT_NEAR(computeCost(Objective::Geodesic, Edge<2>(), Rigid<2>(), turned_about), half * half, 1e-12);
}

}  // namespace
}  // namespace pose_graph::test
