// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "manifold/rotation.hpp"
#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Logarithm of a turn, and of the square of the normal distribution's constant.
const double kLogTwoPi = std::log(2.0 * M_PI);
/// Of the largest eigenvalue of an information: less is round-off.
constexpr double kZeroEigenvalue = 1e-12;

/// An edge with a square root of its information, W^T W = information, one row for each direction that it measures and
/// zeros below. Nothing is inverted, so the information may be singular.
template <int D>
struct WhitenedEdge {
  int from = 0, to = 0;
  Rigid<D> Z;
  TangentMatrix<D> W;
  int rank = 0;
  Eigen::Matrix<double, D, 1> lever = Eigen::Matrix<double, D, 1>::Zero();  ///< as in Edge
};
template <int D>
WhitenedEdge<D> whitened(const Edge<D>& edge);
/// All of them; the root of what successive edges have in common is taken once.
template <int D>
std::vector<WhitenedEdge<D>> whitened(const std::vector<Edge<D>>& edges);

/// W e, with e as in Edge: its square is the edge's cost.
template <int D>
Tangent<D> whitenedError(const WhitenedEdge<D>& edge, const Rigid<D>& from, const Rigid<D>& to);

/// Its derivatives by moves of both poses (moved() of manifold/rotation.hpp), exact at any error.
template <int D>
struct WhitenedJacobians {
  Tangent<D> error;
  TangentMatrix<D> by_from, by_to;
};
template <int D>
WhitenedJacobians<D> whitenedJacobians(const WhitenedEdge<D>& edge, const Rigid<D>& from, const Rigid<D>& to);

}  // namespace pose_graph
