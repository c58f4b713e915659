// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace pose_graph {

/// Dimension of a tangent of SE(D): 3 in the plane, 6 in space. Translation first, then rotation.
template <int D>
constexpr int kTangentSize = D == 2 ? 3 : 6;
template <int D>
using Tangent = Eigen::Matrix<double, kTangentSize<D>, 1>;
template <int D>
using TangentMatrix = Eigen::Matrix<double, kTangentSize<D>, kTangentSize<D>>;

/// A rigid transform of the plane (D = 2) or of space (D = 3) in the solver's representation: a proper rotation matrix,
/// so that a residual takes multiplications only, and a translation (m). p_a = R p_b + t for T_a_b.
template <int D>
struct Rigid {
  Eigen::Matrix<double, D, D> R = Eigen::Matrix<double, D, D>::Identity();
  Eigen::Matrix<double, D, 1> t = Eigen::Matrix<double, D, 1>::Zero();

  Rigid inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
  Rigid operator*(const Rigid& T_b_c) const { return {R * T_b_c.R, R * T_b_c.t + t}; }
};

/// Measures pose `to` in the frame of pose `from`: Z = T_from_to.
///
/// `information` is that of e = (translation of E, rotation vector of E; in the plane its angle) with E = Z^-1
/// T_from^-1 T_to, both parts in the frame of Z's child. It must be symmetric and positive semidefinite, may be
/// singular, and is never inverted. Stage outputs use the axes of `from` instead: rotating both blocks by Z.R converts
/// exactly, for any size of e.
template <int D>
struct Edge {
  int from = 0, to = 0;
  Rigid<D> Z;
  TangentMatrix<D> information = TangentMatrix<D>::Identity();
  /// Lever arm of the measured point in the axes of `to`, m: Z measures T_to displaced by it. Zero except for priors of
  /// sensors with an offset from their pose.
  Eigen::Matrix<double, D, 1> lever = Eigen::Matrix<double, D, 1>::Zero();

  bool hasLever() const { return !lever.isZero(0.0); }
  /// Returns the pose that Z measures: T_to displaced by the lever arm.
  Rigid<D> measured(const Rigid<D>& T_to) const { return {T_to.R, T_to.t + T_to.R * lever}; }
  /// Returns T_to as predicted from T_from and the measurement.
  Rigid<D> predicted(const Rigid<D>& T_from) const {
    const Rigid<D> T = T_from * Z;
    return {T.R, T.t - T.R * lever};
  }
};

/// A pose graph on SE(D). `poses`: initial guess of T_map_i, arbitrary, numbered 0...n-1. Edges may have either
/// direction, and several edges may join a pair of poses.
///
/// Poses in `fixed` (ascending, unique) are constants: they are not unknowns and keep their values to the last bit.
/// They and all poses connected to them share one frame. A component without a fixed pose is free to move as a whole;
/// its first pose is held during relaxation.
///
/// A problem is well-formed if each edge joins two different existing poses, all numbers are finite and each
/// information is symmetric and positive semidefinite.
template <int D>
struct Problem {
  std::vector<Rigid<D>> poses;
  std::vector<Edge<D>> edges;
  std::vector<int> fixed = {};

  /// Returns the same poses, with the same fixed ones, without edges.
  Problem withoutEdges() const { return {poses, {}, fixed}; }
};

/// Cost functions, without a factor of 1/2 (definitions: docs/derivations/pose_graph.md).
enum class Objective {
  Geodesic,  ///< e^T information e, with e as in Edge
  Chordal,   ///< sum of kappa |R_j - R_i R_ij|^2 + tau |t_j - t_i - R_i t_ij|^2 (Rosen et al., SE-Sync, IJRR 2019, eq.
             ///< 11)
  G2o,       ///< e with the vector part of the quaternion instead of the rotation vector, as in g2o
};

}  // namespace pose_graph
