// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pose_graph/graph_file.hpp"

namespace pose_graph {

/// The information of a tangent, as in Edge, from the numbers of a file: those of space are about the quaternion's
/// vector, half the rotation vector.
template <int D>
TangentMatrix<D> tangentInformation(const std::array<double, 21>& upper_triangle);

/// Makes `information` positive semidefinite where only the digits of print are in the way: eigenvalues down to
/// -3e-5 of the largest, which six digits cost at most, become zero.
///
/// Returns false where it is not semidefinite and Semidefinite::Blocks allows that. Throws UserError with `name` and
/// `what` otherwise.
template <int D>
bool demandSemidefinite(Semidefinite demanded, TangentMatrix<D>& information, const std::string& what,
                        const std::string& name);

}  // namespace pose_graph
