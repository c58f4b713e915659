// SPDX-License-Identifier: BSD-3-Clause
#include "condense/chain_sum.hpp"

#include <Eigen/LU>

#include "manifold/rotation.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace pose_graph {

namespace {

template <int D>
using Turn = Eigen::Matrix<double, D, kRotationSize<D>>;

// A twist w about the origin moves a pose at t by (rho, phi) = (w_rho + phi x t, w_phi); also the inverse conversion.
template <int D>
Tangent<D> boxFromTwist(const Tangent<D>& w, const Eigen::Matrix<double, D, 1>& t) {
  Tangent<D> x = w;
  x.template head<D>() += turned(t) * w.template tail<kRotationSize<D>>();
  return x;
}
template <int D>
Tangent<D> twistFromBox(const Tangent<D>& x, const Eigen::Matrix<double, D, 1>& t) {
  Tangent<D> w = x;
  w.template head<D>() -= turned(t) * x.template tail<kRotationSize<D>>();
  return w;
}
// Returns the covariance after a shift of the reference point: J P J^T with J = [I, sign turned(t); 0, I].
template <int D>
TangentMatrix<D> shifted(TangentMatrix<D> P, const Eigen::Matrix<double, D, 1>& t, double sign) {
  constexpr int kR = kRotationSize<D>;
  const Turn<D> turn = sign * turned(t);
  P.template topRows<D>() += turn * P.template bottomRows<kR>();
  P.template leftCols<D>() += P.template rightCols<kR>() * turn.transpose();
  return P;
}
// Rotates both blocks by A.
template <int D>
TangentMatrix<D> turnedBy(const Rotation<D>& A, const TangentMatrix<D>& P) {
  TangentMatrix<D> made;
  if constexpr (D == 2) {
    made.template topLeftCorner<2, 2>() = A * P.template topLeftCorner<2, 2>() * A.transpose();
    made.template topRightCorner<2, 1>() = A * P.template topRightCorner<2, 1>();
    made.template bottomLeftCorner<1, 2>() = made.template topRightCorner<2, 1>().transpose();
    made(2, 2) = P(2, 2);
  } else {
    made.template topLeftCorner<3, 3>() = A * P.template topLeftCorner<3, 3>() * A.transpose();
    made.template topRightCorner<3, 3>() = A * P.template topRightCorner<3, 3>() * A.transpose();
    made.template bottomLeftCorner<3, 3>() = made.template topRightCorner<3, 3>().transpose();
    made.template bottomRightCorner<3, 3>() = A * P.template bottomRightCorner<3, 3>() * A.transpose();
  }
  return made;
}
template <int D>
Tangent<D> turnedBy(const Rotation<D>& A, const Tangent<D>& x) {
  Tangent<D> made = x;
  made.template head<D>() = A * x.template head<D>();
  if constexpr (D == 3) made.template tail<3>() = A * x.template tail<3>();
  return made;
}

// Returns [R, t] relative to `base`: (t - t_base, Log(R R_base^T)).
template <int D>
Tangent<D> boxBetween(const Rigid<D>& T, const Rigid<D>& base) {
  Tangent<D> x;
  x.template head<D>() = T.t - base.t;
  x.template tail<kRotationSize<D>>() = logRotation(Rotation<D>(T.R * base.R.transpose()));
  return x;
}

// Chains contain only edges whose information, scaled to a unit diagonal, is far from singular.
constexpr double kLeastPivot = 1e-10;

}  // namespace

template <int D>
ChainSum<D> linkSum(const Edge<D>& edge, bool against, const TangentMatrix<D>& covariance, const Rigid<D>& before,
                    const Rigid<D>& after, double* cost) {
  constexpr int kR = kRotationSize<D>;
  const Rigid<D>&from = against ? after : before, &to = against ? before : after;
  const Rotation<D> A = from.R * edge.Z.R;
  Tangent<D> e;
  e.template head<D>() = A.transpose() * (to.t - from.t) - edge.Z.R.transpose() * edge.Z.t;
  e.template tail<kR>() = logRotation(Rotation<D>(A.transpose() * to.R));
  *cost += e.dot(edge.information * e);
  // e changes by (A^T rho, J_l^-1 A^T phi) if `to` moves by (rho, phi), and J_l(e) e = e.
  TangentMatrix<D> P = covariance;
  if constexpr (D == 3) {
    if (e.template tail<3>().squaredNorm() > 0.0) {
      const Eigen::Matrix3d J = urban_nav_core::leftJacobianSo3(e.template tail<3>());
      P.template bottomRows<3>() = (J * P.template bottomRows<3>()).eval();
      P.template rightCols<3>() = (P.template rightCols<3>() * J.transpose()).eval();
    }
  }
  ChainSum<D> sum;
  sum.covariance = shifted<D>(turnedBy<D>(A, P), to.t, -1.0);
  sum.shift = twistFromBox<D>(turnedBy<D>(A, Tangent<D>(-e)), to.t);
  if (against) sum.shift = -sum.shift;  // twist of the later pose relative to the earlier one
  return sum;
}

template <int D>
Edge<D> composedEdge(const ChainSum<D>& sum, const Rigid<D>& end) {
  Edge<D> edge;
  const Tangent<D> shift = boxFromTwist<D>(sum.shift, end.t);
  edge.Z = moved<D>(end, shift);
  TangentMatrix<D> P = turnedBy<D>(Rotation<D>(edge.Z.R.transpose()), shifted<D>(sum.covariance, end.t, 1.0));
  // The error of the edge at `end` is -shift, and its derivative there contains J_l^-1. With J_l^-1 in the covariance,
  // the edge has the chain's gradient and second derivative there, and hence the same optimum.
  if constexpr (D == 3) {
    const Eigen::Vector3d e_r = -(end.R.transpose() * shift.template tail<3>());
    const Eigen::Matrix3d J = urban_nav_core::leftJacobianInverseSo3(e_r);
    P.template bottomRows<3>() = (J * P.template bottomRows<3>()).eval();
    P.template rightCols<3>() = (P.template rightCols<3>() * J.transpose()).eval();
  }
  edge.information = urban_nav_core::SmallCholesky<kTangentSize<D>>(P).inverse();
  edge.information = (0.5 * (edge.information + edge.information.transpose())).eval();
  return edge;
}

template <int D>
Tangent<D> twistBetween(const Rigid<D>& wanted, const Rigid<D>& lies) {
  return twistFromBox<D>(boxBetween<D>(wanted, lies), lies.t);
}

template <int D>
Tangent<D> solvedWith(const TangentMatrix<D>& covariance, const Tangent<D>& x) {
  return urban_nav_core::SmallCholesky<kTangentSize<D>>(covariance).solve(x);
}

template <int D>
Rigid<D> pulledStep(const ChainSum<D>& link, const Tangent<D>& pull, const Rigid<D>& before, const Rigid<D>& after) {
  const Tangent<D> y = link.shift + link.covariance * pull;
  return before.inverse() * moved<D>(after, boxFromTwist<D>(y, after.t));
}

template <int D>
bool invert(const TangentMatrix<D>& information, TangentMatrix<D>& inverse) {
  const Tangent<D> diagonal = information.diagonal();
  if (!(diagonal.minCoeff() > 0.0)) return false;
  const Tangent<D> scale = diagonal.cwiseSqrt().cwiseInverse();
  const urban_nav_core::SmallCholesky<kTangentSize<D>> factored(scale.asDiagonal() * information * scale.asDiagonal());
  if (!factored.succeeded() || !(factored.factor().diagonal().cwiseAbs2().minCoeff() > kLeastPivot)) return false;
  inverse = scale.asDiagonal() * factored.solve(TangentMatrix<D>(scale.asDiagonal()));
  return inverse.allFinite();
}

template ChainSum<2> linkSum<2>(const Edge<2>&, bool, const TangentMatrix<2>&, const Rigid<2>&, const Rigid<2>&,
                                double*);
template Edge<2> composedEdge<2>(const ChainSum<2>&, const Rigid<2>&);
template Tangent<2> twistBetween<2>(const Rigid<2>&, const Rigid<2>&);
template Tangent<2> solvedWith<2>(const TangentMatrix<2>&, const Tangent<2>&);
template Rigid<2> pulledStep<2>(const ChainSum<2>&, const Tangent<2>&, const Rigid<2>&, const Rigid<2>&);
template bool invert<2>(const TangentMatrix<2>&, TangentMatrix<2>&);
template ChainSum<3> linkSum<3>(const Edge<3>&, bool, const TangentMatrix<3>&, const Rigid<3>&, const Rigid<3>&,
                                double*);
template Edge<3> composedEdge<3>(const ChainSum<3>&, const Rigid<3>&);
template Tangent<3> twistBetween<3>(const Rigid<3>&, const Rigid<3>&);
template Tangent<3> solvedWith<3>(const TangentMatrix<3>&, const Tangent<3>&);
template Rigid<3> pulledStep<3>(const ChainSum<3>&, const Tangent<3>&, const Rigid<3>&, const Rigid<3>&);
template bool invert<3>(const TangentMatrix<3>&, TangentMatrix<3>&);

}  // namespace pose_graph
