// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pose_graph/graph_file.hpp"

namespace pose_graph {

/// Returns the information of a tangent, as in Edge, from the numbers of a file. In space these refer to the vector
/// part of the quaternion, half the rotation vector.
template <int D>
TangentMatrix<D> tangentInformation(const std::array<double, 21>& upper_triangle);

/// Makes `information` positive semidefinite if it is so up to the printed precision: eigenvalues down to -3e-5 of the
/// largest, the error of six digits, become zero.
///
/// Returns false if it is not semidefinite and Semidefinite::Blocks permits that. Otherwise throws UserError with
/// `name` and `what`.
template <int D>
bool demandSemidefinite(Semidefinite demanded, TangentMatrix<D>& information, const std::string& what,
                        const std::string& name);

}  // namespace pose_graph
