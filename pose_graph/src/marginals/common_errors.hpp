// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/marginals.hpp"
#include "solve/normal_equations.hpp"

namespace pose_graph {

/// Change of a relative pose by each common error, one column per error.
template <int D>
using Displacements = Eigen::Matrix<double, kTangentSize<D>, Eigen::Dynamic>;

/// Returns J^T W s by places, with s the displacement of the measurements by one standard deviation of a common error.
/// H^-1 times it is the displacement of the minimum of the geodesic objective. `number`: by edge of `equations`, its
/// index in CommonError::of_edge.
template <int D>
std::vector<double> commonGradient(const NormalEquations<D>& equations, const std::vector<Rigid<D>>& poses,
                                   const CommonError<D>& common, const std::vector<std::size_t>& number);

/// Adds the covariance of the columns of `moved`, each of unit variance. A singular information is reduced as if its
/// inverse existed: I - I U (1 + U^T I U)^-1 U^T I.
template <int D>
void consider(const Displacements<D>& moved, Marginal<D>& marginal);

}  // namespace pose_graph
