// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "manifold/rotation.hpp"

namespace pose_graph {

/// Motion of poses due to increments of the chain's links, in one common frame.
///
/// The increment (rho, phi) of link v_r is in the frame of pose r - 1: v = [Exp(phi) R, t + rho]. With a = R_{r-1} rho
/// and b = R_{r-1} phi, pose k > r - 1 moves by a + b x (p_k - p_r) and rotates by b. The sums over the links up to k
///
///     A_k = sum (a_r + p_r x b_r),   B_k = sum b_r
///
/// determine the motion of pose k, delta p_k = A_k - p_k x B_k. A closure between m and q depends only on the
/// difference x_q - x_m of x = (A, B), in either direction. This is eq. 10-16 of Newman et al. 2009, with the products
/// of Jacobians of eq. 13 separated into a factor of the link and a factor of the closure: a product with H takes one
/// sweep along the chain instead of one along each loop. In the plane the cross products are those of vectors with z =
/// 0.

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;

/// p x b.
template <int D>
Vector<D> crossTurn(const Vector<D>& p, const RotationVector<D>& b) {
  if constexpr (D == 2) return {p.y() * b[0], -p.x() * b[0]};
  else return p.cross(b);
}

/// p x f, a moment.
template <int D>
RotationVector<D> crossForce(const Vector<D>& p, const Vector<D>& f) {
  if constexpr (D == 2) return RotationVector<D>(p.x() * f.y() - p.y() * f.x());
  else return p.cross(f);
}

template <int D>
RotationVector<D> rotateTurn(const Rotation<D>& R, const RotationVector<D>& phi) {
  if constexpr (D == 2) return phi;
  else return R * phi;
}
template <int D>
RotationVector<D> rotateTurnBack(const Rotation<D>& R, const RotationVector<D>& phi) {
  if constexpr (D == 2) return phi;
  else return R.transpose() * phi;
}

/// Returns the contribution of link r to x: (a + p_r x b, b), for the increment d of the link.
template <int D>
Tangent<D> linkTwist(const Rigid<D>& previous, const Vector<D>& p, const Tangent<D>& d) {
  constexpr int kTurn = kRotationSize<D>;
  const RotationVector<D> b = rotateTurn<D>(previous.R, d.template tail<kTurn>());
  Tangent<D> x;
  x.template head<D>() = previous.R * d.template head<D>() + crossTurn<D>(p, b);
  x.template tail<kTurn>() = b;
  return x;
}

/// Transposed map: returns the force and moment on the link for a force `z` on x.
template <int D>
Tangent<D> linkForce(const Rigid<D>& previous, const Vector<D>& p, const Tangent<D>& z) {
  constexpr int kTurn = kRotationSize<D>;
  const Vector<D> f = z.template head<D>();
  Tangent<D> d;
  d.template head<D>() = previous.R.transpose() * f;
  d.template tail<kTurn>() =
      rotateTurnBack<D>(previous.R, RotationVector<D>(z.template tail<kTurn>() - crossForce<D>(p, f)));
  return d;
}

/// Returns linkTwist() as a matrix.
template <int D>
TangentMatrix<D> linkMatrix(const Rigid<D>& previous, const Vector<D>& p) {
  TangentMatrix<D> U;
  for (int i = 0; i < kTangentSize<D>; ++i) U.col(i) = linkTwist<D>(previous, p, Tangent<D>::Unit(i));
  return U;
}

/// The residual e of an edge, as in Edge, and K with de = K (x_to - x_from).
template <int D>
struct EdgeRow {
  Tangent<D> e;
  TangentMatrix<D> K;
};
template <int D>
EdgeRow<D> edgeRow(const Edge<D>& edge, const Rigid<D>& T_map_from, const Rigid<D>& T_map_to);
template <int D>
Tangent<D> edgeResidual(const Edge<D>& edge, const Rigid<D>& T_map_from, const Rigid<D>& T_map_to);

/// Returns the product with its rotation renormalised, since products along a chain have thousands of factors.
template <int D>
Rigid<D> chained(const Rigid<D>& T_a_b, const Rigid<D>& T_b_c);

}  // namespace pose_graph
