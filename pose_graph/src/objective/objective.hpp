// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "manifold/rotation.hpp"
#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Precomputed data of an edge. `kappa`, `tau`: weights of rotation and translation in the chordal objective.
template <int D>
struct EdgeTerm {
  int from = 0, to = 0;
  Rotation<D> R_Z;
  Eigen::Matrix<double, D, 1> t_Z;  ///< translation of Z in the frame of its child: R_Z^T t
  TangentMatrix<D> information;
  double kappa = 0.0, tau = 0.0;
  Eigen::Matrix<double, D, 1> lever = Eigen::Matrix<double, D, 1>::Zero();  ///< as in Edge
  bool has_lever = false;

  /// Returns the pose that Z measures: `to` displaced by the lever arm.
  Rigid<D> measured(const Rigid<D>& to) const { return has_lever ? Rigid<D>{to.R, to.t + to.R * lever} : to; }
};
template <int D>
EdgeTerm<D> makeTerm(const Edge<D>& edge);

/// Quadratic approximation of an edge's cost. With A = R_from R_Z (predicted rotation of Z's child in the map) and d =
/// t_to - t_from, every objective is a function of e_t = A^T d - R_Z^T t_Z and R_E = A^T R_to, and is invariant under a
/// common motion of both poses. Moving `to` by y, in the axes of A, changes it to
///   cost + 2 g^T y + y^T H y + ...
/// H is the Gauss-Newton matrix, positive semidefinite.
template <int D>
struct LocalQuadratic {
  double cost = 0.0;
  Tangent<D> g;
  TangentMatrix<D> H;
};
template <Objective objective, int D>
LocalQuadratic<D> localQuadratic(const EdgeTerm<D>& term, const Eigen::Matrix<double, D, 1>& e_t,
                                 const Rotation<D>& R_E);

/// The rotation error of an objective and its derivative with respect to a left rotation of R_E. Not used for the
/// chordal objective.
template <int D>
struct RotationError {
  RotationVector<D> e;
  Eigen::Matrix<double, kRotationSize<D>, kRotationSize<D>> J;
};
template <Objective objective>
RotationError<2> rotationError(const Rotation<2>& R_E);
template <Objective objective>
RotationError<3> rotationError(const Rotation<3>& R_E);

/// Returns the cost without derivatives.
template <Objective objective, int D>
double localCost(const EdgeTerm<D>& term, const Eigen::Matrix<double, D, 1>& e_t, const Rotation<D>& R_E);

/// The approximation in the map's axes, for both poses moved by x_from and x_to (moved() of manifold/rotation.hpp):
///   cost + 2 (g_from^T x_from + g_to^T x_to) + x_to^T K x_to + ...
/// Derivatives with respect to `from` follow from the invariance under a common motion. With T = [I, -[d]x; 0, I]:
///   g_from = -T^T g_to,  H_from_to = -T^T K,  H_from_from = T^T K T.
template <int D>
struct EdgeQuadratic {
  double cost = 0.0;
  Eigen::Matrix<double, D, 1> d;
  Tangent<D> g_to;
  TangentMatrix<D> K;
};

/// Converts a quadratic for the end of a lever arm to one for the pose. A rotation phi of the pose displaces the end,
/// at `arm` in the map's axes, by phi x arm. `d` becomes that of the pose.
template <int D>
void moveFromLever(const Eigen::Matrix<double, D, 1>& arm, EdgeQuadratic<D>& quadratic) {
  constexpr int kR = kRotationSize<D>;
  const Eigen::Matrix<double, D, kR> turn = turned(arm);
  quadratic.d -= arm;
  quadratic.g_to.template tail<kR>() += turn.transpose() * quadratic.g_to.template head<D>();
  quadratic.K.template rightCols<kR>() += (quadratic.K.template leftCols<D>() * turn).eval();
  quadratic.K.template bottomRows<kR>() += (turn.transpose() * quadratic.K.template topRows<D>()).eval();
}

template <Objective objective, int D>
EdgeQuadratic<D> edgeQuadraticAtLever(const EdgeTerm<D>& term, const Rigid<D>& from, const Rigid<D>& to) {
  EdgeQuadratic<D> made;
  const Rotation<D> A = from.R * term.R_Z;
  made.d = to.t - from.t;
  const LocalQuadratic<D> local =
      localQuadratic<objective, D>(term, A.transpose() * made.d - term.t_Z, A.transpose() * to.R);
  made.cost = local.cost;
  constexpr int kR = kRotationSize<D>;
  if constexpr (D == 2) {
    made.g_to.template head<2>() = A * local.g.template head<2>();
    made.g_to[2] = local.g[2];
    made.K.template topLeftCorner<2, 2>() = A * local.H.template topLeftCorner<2, 2>() * A.transpose();
    made.K.template topRightCorner<2, 1>() = A * local.H.template topRightCorner<2, 1>();
    made.K.template bottomLeftCorner<1, 2>() = made.K.template topRightCorner<2, 1>().transpose();
    made.K(2, 2) = local.H(2, 2);
  } else {
    made.g_to.template head<D>() = A * local.g.template head<D>();
    made.g_to.template tail<kR>() = A * local.g.template tail<kR>();
    made.K.template topLeftCorner<D, D>() = A * local.H.template topLeftCorner<D, D>() * A.transpose();
    made.K.template topRightCorner<D, kR>() = A * local.H.template topRightCorner<D, kR>() * A.transpose();
    made.K.template bottomLeftCorner<kR, D>() = made.K.template topRightCorner<D, kR>().transpose();
    made.K.template bottomRightCorner<kR, kR>() = A * local.H.template bottomRightCorner<kR, kR>() * A.transpose();
  }
  return made;
}

template <Objective objective, int D>
EdgeQuadratic<D> edgeQuadratic(const EdgeTerm<D>& term, const Rigid<D>& from, const Rigid<D>& to) {
  if (!term.has_lever) return edgeQuadraticAtLever<objective, D>(term, from, to);
  EdgeQuadratic<D> quadratic = edgeQuadraticAtLever<objective, D>(term, from, term.measured(to));
  moveFromLever<D>(to.R * term.lever, quadratic);
  return quadratic;
}

template <Objective objective, int D>
double edgeCost(const EdgeTerm<D>& term, const Rigid<D>& from, const Rigid<D>& pose) {
  const Rotation<D> A = from.R * term.R_Z;
  const Eigen::Matrix<double, D, 1> to = term.has_lever ? term.measured(pose).t : pose.t;
  return localCost<objective, D>(term, A.transpose() * (to - from.t) - term.t_Z, A.transpose() * pose.R);
}

}  // namespace pose_graph
