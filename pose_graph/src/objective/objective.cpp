// SPDX-License-Identifier: BSD-3-Clause
#include "objective/objective.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace pose_graph {

namespace {

// Returns 1 / trace(M^-1) of a positive semidefinite M; 0, the limit, if M is singular.
template <int N>
double harmonic(const Eigen::Matrix<double, N, N>& M) {
  const double size = M.trace();
  if (!(size > 0.0)) return 0.0;
  bool invertible = false;
  Eigen::Matrix<double, N, N> inverse;
  M.computeInverseWithCheck(inverse, invertible, 0.0);
  const double trace = inverse.trace();
  return invertible && trace > 0.0 ? 1.0 / trace : 0.0;
}

RotationError<3> geodesicError(const Rotation<3>& R_E) {
  const Eigen::Vector3d e = logRotation(R_E);
  return {e, urban_nav_core::leftJacobianInverseSo3(e)};
}

// Twice the vector part of the quaternion, which equals the rotation vector for small angles.
RotationError<3> quaternionError(const Rotation<3>& R_E) {
  Eigen::Quaterniond q(R_E);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return {2.0 * q.vec(), q.w() * Eigen::Matrix3d::Identity() - urban_nav_core::skew(q.vec())};
}

}  // namespace

template <Objective objective>
RotationError<2> rotationError(const Rotation<2>& R_E) {
  return {logRotation(R_E), Eigen::Matrix<double, 1, 1>::Ones()};
}
template <Objective objective>
RotationError<3> rotationError(const Rotation<3>& R_E) {
  return objective == Objective::Geodesic ? geodesicError(R_E) : quaternionError(R_E);
}

namespace {

template <Objective objective, int D>
Tangent<D> computeError(const Eigen::Matrix<double, D, 1>& e_t, const Rotation<D>& R_E) {
  Tangent<D> e;
  e.template head<D>() = e_t;
  if constexpr (D == 2) {
    e[2] = logRotation(R_E)[0];
  } else {
    e.template tail<3>() = rotationError<objective>(R_E).e;
  }
  return e;
}

// |R_E - I|^2 (Frobenius).
template <int D>
double chordSquared(const Rotation<D>& R_E) {
  return (R_E - Rotation<D>::Identity()).squaredNorm();
}

// Returns the axis of the skew part of R: tr([phi]x R) = -phi . axis.
RotationVector<2> skewAxis(const Rotation<2>& R) { return RotationVector<2>(R(1, 0) - R(0, 1)); }
RotationVector<3> skewAxis(const Rotation<3>& R) { return {R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)}; }

template <int D>
LocalQuadratic<D> chordalQuadratic(const EdgeTerm<D>& term, const Eigen::Matrix<double, D, 1>& e_t,
                                   const Rotation<D>& R_E) {
  constexpr int kR = kRotationSize<D>;
  LocalQuadratic<D> made;
  made.cost = term.kappa * chordSquared<D>(R_E) + term.tau * e_t.squaredNorm();
  made.g.template head<D>() = term.tau * e_t;
  made.g.template tail<kR>() = term.kappa * skewAxis(R_E);
  made.H.setZero();
  made.H.diagonal().template head<D>().setConstant(term.tau);
  made.H.diagonal().template tail<kR>().setConstant(2.0 * term.kappa);  // |[phi]x R|^2 = 2 |phi|^2
  return made;
}

}  // namespace

template <int D>
EdgeTerm<D> makeTerm(const Edge<D>& edge) {
  constexpr int kR = kRotationSize<D>;
  EdgeTerm<D> made;
  made.from = edge.from;
  made.to = edge.to;
  made.R_Z = edge.Z.R;
  made.t_Z = edge.Z.R.transpose() * edge.Z.t;
  made.information = edge.information;
  made.lever = edge.lever;
  made.has_lever = edge.hasLever();
  made.tau = D * harmonic<D>(edge.information.template topLeftCorner<D, D>());
  // SE-Sync uses 3 / (2 trace) of the information of the quaternion's vector part, which is four times that of the
  // rotation vector.
  made.kappa =
      D == 2 ? edge.information(D, D) : 6.0 * harmonic<kR>(edge.information.template bottomRightCorner<kR, kR>());
  return made;
}

template <Objective objective, int D>
LocalQuadratic<D> localQuadratic(const EdgeTerm<D>& term, const Eigen::Matrix<double, D, 1>& e_t,
                                 const Rotation<D>& R_E) {
  if constexpr (objective == Objective::Chordal) {
    return chordalQuadratic<D>(term, e_t, R_E);
  } else if constexpr (D == 2) {
    LocalQuadratic<D> made;
    const Tangent<D> e = computeError<objective, D>(e_t, R_E);
    made.g = term.information * e;
    made.H = term.information;
    made.cost = e.dot(made.g);
    return made;
  } else {
    LocalQuadratic<D> made;
    const RotationError<3> rotation = rotationError<objective>(R_E);
    Tangent<D> e;
    e << e_t, rotation.e;
    const Tangent<D> weighted = term.information * e;
    made.cost = e.dot(weighted);
    made.g << weighted.template head<3>(), rotation.J.transpose() * weighted.template tail<3>();
    made.H.template topLeftCorner<3, 3>() = term.information.template topLeftCorner<3, 3>();
    made.H.template topRightCorner<3, 3>() = term.information.template topRightCorner<3, 3>() * rotation.J;
    made.H.template bottomLeftCorner<3, 3>() = made.H.template topRightCorner<3, 3>().transpose();
    made.H.template bottomRightCorner<3, 3>() =
        rotation.J.transpose() * term.information.template bottomRightCorner<3, 3>() * rotation.J;
    return made;
  }
}

template <Objective objective, int D>
double localCost(const EdgeTerm<D>& term, const Eigen::Matrix<double, D, 1>& e_t, const Rotation<D>& R_E) {
  if constexpr (objective == Objective::Chordal) {
    return term.kappa * chordSquared<D>(R_E) + term.tau * e_t.squaredNorm();
  } else {
    const Tangent<D> e = computeError<objective, D>(e_t, R_E);
    return e.dot(term.information * e);
  }
}

template RotationError<2> rotationError<Objective::Geodesic>(const Rotation<2>&);
template RotationError<2> rotationError<Objective::G2o>(const Rotation<2>&);
template RotationError<3> rotationError<Objective::Geodesic>(const Rotation<3>&);
template RotationError<3> rotationError<Objective::G2o>(const Rotation<3>&);

#define POSE_GRAPH_OBJECTIVE(objective, D)                                                                        \
  template LocalQuadratic<D> localQuadratic<objective, D>(const EdgeTerm<D>&, const Eigen::Matrix<double, D, 1>&, \
                                                          const Rotation<D>&);                                    \
  template double localCost<objective, D>(const EdgeTerm<D>&, const Eigen::Matrix<double, D, 1>&, const Rotation<D>&);
POSE_GRAPH_OBJECTIVE(Objective::Geodesic, 2)
POSE_GRAPH_OBJECTIVE(Objective::Geodesic, 3)
POSE_GRAPH_OBJECTIVE(Objective::Chordal, 2)
POSE_GRAPH_OBJECTIVE(Objective::Chordal, 3)
POSE_GRAPH_OBJECTIVE(Objective::G2o, 2)
POSE_GRAPH_OBJECTIVE(Objective::G2o, 3)
#undef POSE_GRAPH_OBJECTIVE
template EdgeTerm<2> makeTerm<2>(const Edge<2>&);
template EdgeTerm<3> makeTerm<3>(const Edge<3>&);

}  // namespace pose_graph
