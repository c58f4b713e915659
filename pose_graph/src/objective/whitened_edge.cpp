// SPDX-License-Identifier: BSD-3-Clause
#include "objective/whitened_edge.hpp"

#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"

namespace pose_graph {

namespace {

// d Log(Exp(d) R) at d = 0, R = Exp(phi): the inverse of the left Jacobian (Sola et al., A micro Lie theory, eq. 146).
Eigen::Matrix3d logByLeft(const RotationVector<3>& phi) {
  const double angle = phi.norm();
  const Eigen::Matrix3d cross = -turned(phi);
  // Near pi, `second` is replaced by the limit of (1 + cos) / sin.
  const double second = angle < 1e-4 ? 1.0 / 12.0
                        : angle > 3.14
                            ? 1.0 / (angle * angle)
                            : 1.0 / (angle * angle) - (1.0 + std::cos(angle)) / (2.0 * angle * std::sin(angle));
  return Eigen::Matrix3d::Identity() - 0.5 * cross + second * cross * cross;
}

}  // namespace

template <int D>
WhitenedEdge<D> whitened(const Edge<D>& edge) {
  WhitenedEdge<D> made;
  made.from = edge.from;
  made.to = edge.to;
  made.Z = edge.Z;
  made.lever = edge.lever;
  made.W.setZero();
  const auto eigen = urban_nav_core::smallEigen<kTangentSize<D>>(edge.information);
  const Tangent<D>& values = eigen.values;
  for (int a = kTangentSize<D> - 1; a >= 0; --a) {
    if (!(values[a] > kZeroEigenvalue * values[kTangentSize<D> - 1])) continue;
    made.W.row(made.rank++) = std::sqrt(values[a]) * eigen.vectors.col(a).transpose();
  }
  return made;
}

template <int D>
std::vector<WhitenedEdge<D>> whitened(const std::vector<Edge<D>>& edges) {
  std::vector<WhitenedEdge<D>> made;
  made.reserve(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (e == 0 || edges[e].information != edges[e - 1].information) {
      made.push_back(whitened(edges[e]));
      continue;
    }
    made.push_back(made.back());
    made.back().from = edges[e].from;
    made.back().to = edges[e].to;
    made.back().Z = edges[e].Z;
    made.back().lever = edges[e].lever;
  }
  return made;
}

template <int D>
Tangent<D> whitenedError(const WhitenedEdge<D>& edge, const Rigid<D>& from, const Rigid<D>& to) {
  const Rotation<D> A = from.R * edge.Z.R;
  Tangent<D> e;
  e.template head<D>() = A.transpose() * (to.t + to.R * edge.lever - from.t) - edge.Z.R.transpose() * edge.Z.t;
  e.template tail<kRotationSize<D>>() = logRotation(Rotation<D>(A.transpose() * to.R));
  return edge.W * e;
}

template <int D>
WhitenedJacobians<D> whitenedJacobians(const WhitenedEdge<D>& edge, const Rigid<D>& from, const Rigid<D>& to) {
  constexpr int kR = kRotationSize<D>;
  const Rotation<D> A = from.R * edge.Z.R;
  const Eigen::Matrix<double, D, 1> arm = to.R * edge.lever, d = to.t + arm - from.t;
  Tangent<D> e;
  e.template head<D>() = A.transpose() * d - edge.Z.R.transpose() * edge.Z.t;
  e.template tail<kR>() = logRotation(Rotation<D>(A.transpose() * to.R));
  TangentMatrix<D> by_to = TangentMatrix<D>::Zero(), by_from;
  by_to.template topLeftCorner<D, D>() = A.transpose();
  if constexpr (D == 2) by_to(2, 2) = 1.0;
  else by_to.template bottomRightCorner<kR, kR>() = logByLeft(RotationVector<D>(e.template tail<kR>())) * A.transpose();
  by_from = -by_to;
  by_from.template topRightCorner<D, kR>() = -A.transpose() * turned(d);
  by_to.template topRightCorner<D, kR>() = A.transpose() * turned(arm);
  WhitenedJacobians<D> made;
  made.error = edge.W * e;
  made.by_from = edge.W * by_from;
  made.by_to = edge.W * by_to;
  return made;
}

template WhitenedEdge<2> whitened<2>(const Edge<2>&);
template WhitenedEdge<3> whitened<3>(const Edge<3>&);
template std::vector<WhitenedEdge<2>> whitened<2>(const std::vector<Edge<2>>&);
template std::vector<WhitenedEdge<3>> whitened<3>(const std::vector<Edge<3>>&);
template Tangent<2> whitenedError<2>(const WhitenedEdge<2>&, const Rigid<2>&, const Rigid<2>&);
template Tangent<3> whitenedError<3>(const WhitenedEdge<3>&, const Rigid<3>&, const Rigid<3>&);
template WhitenedJacobians<2> whitenedJacobians<2>(const WhitenedEdge<2>&, const Rigid<2>&, const Rigid<2>&);
template WhitenedJacobians<3> whitenedJacobians<3>(const WhitenedEdge<3>&, const Rigid<3>&, const Rigid<3>&);

}  // namespace pose_graph
