// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "manifold/rotation.hpp"
#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Log of a full turn, and of the square of the normal distribution's constant.
const double kLogTwoPi = std::log(2.0 * M_PI);
/// Share of the largest eigenvalue of an information below which an eigenvalue is round-off.
constexpr double kZeroEigenvalue = 1e-12;

/// An edge with a square root of its information, W^T W = information: one row per measured direction, followed by zero
/// rows. The information may be singular.
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
/// Whitens all edges; equal information of successive edges is decomposed once.
template <int D>
std::vector<WhitenedEdge<D>> whitened(const std::vector<Edge<D>>& edges);

/// Returns W e, with e as in Edge: its square is the edge's cost.
template <int D>
Tangent<D> whitenedError(const WhitenedEdge<D>& edge, const Rigid<D>& from, const Rigid<D>& to);

/// The whitened error and its derivatives with respect to moves of both poses (moved() of manifold/rotation.hpp), exact
/// at any error.
template <int D>
struct WhitenedJacobians {
  Tangent<D> error;
  TangentMatrix<D> by_from, by_to;
};
template <int D>
WhitenedJacobians<D> whitenedJacobians(const WhitenedEdge<D>& edge, const Rigid<D>& from, const Rigid<D>& to);

}  // namespace pose_graph
