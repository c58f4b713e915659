// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "objective/objective.hpp"

namespace pose_graph {

/// Number of residual rows of an edge; a chordal one has all entries of a matrix and a vector.
template <Objective objective, int D>
constexpr int kResidualSize = objective == Objective::Chordal ? D* D + D : kTangentSize<D>;

/// An edge's cost as a sum of squares, and its derivatives with respect to moves of the poses as in EdgeQuadratic.
template <Objective objective, int D>
struct EdgeResidual {
  Eigen::Matrix<double, kResidualSize<objective, D>, 1> r;
  Eigen::Matrix<double, kResidualSize<objective, D>, kTangentSize<D>> J_from, J_to;
};

/// `root`: of the edge's information, root^T root; the chordal objective uses the weights in `term`.
template <Objective objective, int D>
EdgeResidual<objective, D> edgeResidual(const EdgeTerm<D>& term, const TangentMatrix<D>& root, const Rigid<D>& from,
                                        const Rigid<D>& to);

}  // namespace pose_graph
