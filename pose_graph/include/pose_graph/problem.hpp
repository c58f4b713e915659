// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace pose_graph {

/// Numbers of a tangent of SE(D): 3 in the plane, 6 in space. Translation first, then rotation.
template <int D>
constexpr int kTangentSize = D == 2 ? 3 : 6;
template <int D>
using Tangent = Eigen::Matrix<double, kTangentSize<D>, 1>;
template <int D>
using TangentMatrix = Eigen::Matrix<double, kTangentSize<D>, kTangentSize<D>>;

/// A rigid transform of the plane (D = 2) or of space (D = 3) as the solver keeps it: a proper rotation matrix, so that
/// a residual costs products alone, and a translation (m). p_a = R p_b + t for T_a_b.
template <int D>
struct Rigid {
  Eigen::Matrix<double, D, D> R = Eigen::Matrix<double, D, D>::Identity();
  Eigen::Matrix<double, D, 1> t = Eigen::Matrix<double, D, 1>::Zero();

  Rigid inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
  Rigid operator*(const Rigid& T_b_c) const { return {R * T_b_c.R, R * T_b_c.t + t}; }
};

/// Measures pose `to` in the frame of pose `from`: Z = T_from_to.
///
/// `information` is that of e = (translation of E, rotation vector of E; in the plane its angle), E = Z^-1 T_from^-1
/// T_to: both parts in the frame of Z's child. It may be singular and is never inverted; it must be symmetric and
/// positive semidefinite. The convention of everything that leaves a stage is the same one seen from `from`: turn both
/// blocks by Z.R, exactly, at any size of e.
template <int D>
struct Edge {
  int from = 0, to = 0;
  Rigid<D> Z;
  TangentMatrix<D> information = TangentMatrix<D>::Identity();
  /// Lever arm, m, of the point that is measured, in the axes of `to`: Z measures T_to shifted by it. Zero but for
  /// priors of sensors away from their pose.
  Eigen::Matrix<double, D, 1> lever = Eigen::Matrix<double, D, 1>::Zero();

  bool hasLever() const { return !lever.isZero(0.0); }
  /// T_to as Z measures it.
  Rigid<D> measured(const Rigid<D>& T_to) const { return {T_to.R, T_to.t + T_to.R * lever}; }
  /// T_to from T_from, as measured.
  Rigid<D> predicted(const Rigid<D>& T_from) const {
    const Rigid<D> T = T_from * Z;
    return {T.R, T.t - T.R * lever};
  }
};

/// A pose graph on SE(D): `poses` are T_map_i, the first guess (any), named 0...n-1; an edge may run either way, and a
/// pair of poses may have several.
///
/// Poses in `fixed` are constants: they are no unknowns, stay where `poses` has them to the last bit, and what they are
/// joined to lies in their common frame. Ascending, each once. A part of the graph without a fixed pose is free to move
/// as a whole; the first of its poses is held while it is relaxed.
template <int D>
struct Problem {
  std::vector<Rigid<D>> poses;
  std::vector<Edge<D>> edges;
  std::vector<int> fixed = {};

  /// The same poses, fixed as they are, without any edge.
  Problem withoutEdges() const { return {poses, {}, fixed}; }
};

/// What is minimised, each without the factor 1/2 (definitions: README.md, "Costs").
enum class Objective {
  Geodesic,  ///< e^T information e, e as in Edge
  Chordal,   ///< sum of kappa |R_j - R_i R_ij|^2 + tau |t_j - t_i - R_i t_ij|^2 (Rosen et al., SE-Sync, IJRR 2019, eq.
             ///< 11)
  G2o,       ///< e with the quaternion's vector in place of the rotation vector, as g2o has it
};

}  // namespace pose_graph
