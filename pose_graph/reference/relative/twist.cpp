// SPDX-License-Identifier: BSD-3-Clause
#include "twist.hpp"

namespace pose_graph {
namespace {

// A product of two rotations deviates by round-off only, for which this equals the nearest rotation and is fast.
Rotation<2> proper(const Rotation<2>& R) { return nearestRotation(R); }
Rotation<3> proper(const Rotation<3>& R) { return Eigen::Quaterniond(R).normalized().toRotationMatrix(); }

// d Log(Exp(theta) R) / d theta at Log(R) = phi.
Eigen::Matrix<double, 1, 1> leftJacobianInverse(const RotationVector<2>&) {
  return Eigen::Matrix<double, 1, 1>::Ones();
}
Rotation<3> leftJacobianInverse(const RotationVector<3>& phi) { return urban_nav_core::leftJacobianInverseSo3(phi); }

}  // namespace

template <int D>
Tangent<D> edgeResidual(const Edge<D>& edge, const Rigid<D>& T_map_from, const Rigid<D>& T_map_to) {
  constexpr int kTurn = kRotationSize<D>;
  const Rotation<D> R_Z_map = (T_map_from.R * edge.Z.R).transpose();
  Tangent<D> e;
  e.template head<D>() = R_Z_map * (T_map_to.t - T_map_from.t - T_map_from.R * edge.Z.t);
  e.template tail<kTurn>() = logRotation(Rotation<D>(R_Z_map * T_map_to.R));
  return e;
}

template <int D>
EdgeRow<D> edgeRow(const Edge<D>& edge, const Rigid<D>& T_map_from, const Rigid<D>& T_map_to) {
  constexpr int kTurn = kRotationSize<D>;
  EdgeRow<D> row;
  row.e = edgeResidual(edge, T_map_from, T_map_to);
  const RotationVector<D> phi = row.e.template tail<kTurn>();
  const Rotation<D> R_Z_map = (T_map_from.R * edge.Z.R).transpose();
  const auto J = leftJacobianInverse(phi);
  // For x_to - x_from = (A, B), pose `to` moves by A - p_to x B and rotates by B, in the axes of the map.
  row.K.setZero();
  row.K.template topLeftCorner<D, D>() = R_Z_map;
  for (int i = 0; i < kTurn; ++i) {
    const RotationVector<D> B = RotationVector<D>::Unit(i);
    row.K.template block<D, 1>(0, D + i) = -(R_Z_map * crossTurn<D>(T_map_to.t, B));
    row.K.template block<kTurn, 1>(D, D + i) = J * rotateTurn<D>(R_Z_map, B);
  }
  return row;
}

template <int D>
Rigid<D> chained(const Rigid<D>& T_a_b, const Rigid<D>& T_b_c) {
  return {proper((T_a_b.R * T_b_c.R).eval()), T_a_b.R * T_b_c.t + T_a_b.t};
}

template Tangent<2> edgeResidual(const Edge<2>&, const Rigid<2>&, const Rigid<2>&);
template Tangent<3> edgeResidual(const Edge<3>&, const Rigid<3>&, const Rigid<3>&);
template EdgeRow<2> edgeRow(const Edge<2>&, const Rigid<2>&, const Rigid<2>&);
template EdgeRow<3> edgeRow(const Edge<3>&, const Rigid<3>&, const Rigid<3>&);
template Rigid<2> chained(const Rigid<2>&, const Rigid<2>&);
template Rigid<3> chained(const Rigid<3>&, const Rigid<3>&);

}  // namespace pose_graph
