// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Returns whether relaxed rotations are so far from the measured ones, on average or at one edge, that a lower local
/// minimum may exist. `weights` as in cost().
template <int D>
bool isTangled(const Problem<D>& problem, const std::vector<double>& weights, const std::vector<Rigid<D>>& poses);

extern template bool isTangled<2>(const Problem<2>&, const std::vector<double>&, const std::vector<Rigid<2>>&);
extern template bool isTangled<3>(const Problem<3>&, const std::vector<double>&, const std::vector<Rigid<3>>&);

}  // namespace pose_graph
