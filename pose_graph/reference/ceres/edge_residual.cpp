// SPDX-License-Identifier: BSD-3-Clause
#include "edge_residual.hpp"

#include <cmath>

namespace pose_graph {

namespace {

/// Writes sqrt(kappa) (R_E - I), column by column, and its derivative with respect to a left rotation of R_E.
template <int D>
void putChord(const Rotation<D>& R_E, double root_kappa, Eigen::Ref<Eigen::Matrix<double, D * D, 1>> r,
              Eigen::Ref<Eigen::Matrix<double, D * D, kRotationSize<D>>, 0, Eigen::OuterStride<>> J) {
  for (int c = 0; c < D; ++c) {
    r.template segment<D>(D * c) = root_kappa * (R_E.col(c) - Rotation<D>::Identity().col(c));
    J.template middleRows<D>(D * c) = root_kappa * turned(Eigen::Matrix<double, D, 1>(R_E.col(c)));
  }
}

}  // namespace

template <Objective objective, int D>
EdgeResidual<objective, D> edgeResidual(const EdgeTerm<D>& term, const TangentMatrix<D>& root, const Rigid<D>& from,
                                        const Rigid<D>& to) {
  constexpr int kR = kRotationSize<D>;
  const Rotation<D> A = from.R * term.R_Z, R_E = A.transpose() * to.R;
  const Eigen::Matrix<double, D, 1> arm = term.measured(to).t - to.t, d = to.t + arm - from.t,
                                    e_t = A.transpose() * d - term.t_Z;
  EdgeResidual<objective, D> made;
  auto& J = made.J_to;  // in the axes of A until rotated below
  J.setZero();
  if constexpr (objective == Objective::Chordal) {
    putChord<D>(R_E, std::sqrt(term.kappa), made.r.template head<D * D>(), J.template topRightCorner<D * D, kR>());
    made.r.template tail<D>() = std::sqrt(term.tau) * e_t;
    J.template bottomLeftCorner<D, D>().diagonal().setConstant(std::sqrt(term.tau));
  } else {
    const RotationError<D> rotation = rotationError<objective>(R_E);
    made.r.template head<D>() = e_t;
    made.r.template tail<kR>() = rotation.e;
    J.template topLeftCorner<D, D>().setIdentity();
    J.template bottomRightCorner<kR, kR>() = rotation.J;
    made.r = (root * made.r).eval();
    J = (root * J).eval();
  }
  J.template leftCols<D>() = (J.template leftCols<D>() * A.transpose()).eval();
  if constexpr (D == 3) J.template rightCols<3>() = (J.template rightCols<3>() * A.transpose()).eval();
  made.J_from = -J;
  made.J_from.template rightCols<kR>() -= J.template leftCols<D>() * turned(d);
  if (term.has_lever) J.template rightCols<kR>() += (J.template leftCols<D>() * turned(arm)).eval();
  return made;
}

#define POSE_GRAPH_RESIDUAL(objective, D)                                                                     \
  template EdgeResidual<objective, D> edgeResidual<objective, D>(const EdgeTerm<D>&, const TangentMatrix<D>&, \
                                                                 const Rigid<D>&, const Rigid<D>&);
POSE_GRAPH_RESIDUAL(Objective::Geodesic, 2)
POSE_GRAPH_RESIDUAL(Objective::Geodesic, 3)
POSE_GRAPH_RESIDUAL(Objective::Chordal, 2)
POSE_GRAPH_RESIDUAL(Objective::Chordal, 3)
POSE_GRAPH_RESIDUAL(Objective::G2o, 2)
POSE_GRAPH_RESIDUAL(Objective::G2o, 3)
#undef POSE_GRAPH_RESIDUAL

}  // namespace pose_graph
