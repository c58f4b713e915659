// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Moves each part of a graph rigidly so that its positions best fit the measurements from fixed poses, weighted by
/// information (Umeyama, least-squares estimation of transformation parameters, PAMI 1991, without scale). A part
/// consists of poses joined by edges without passing a fixed pose. A part is not moved if such an edge also measures
/// its rotation, or if fewer than two edges measure its positions. `weights` as in cost().
template <int D>
void alignWithFixed(const Problem<D>& problem, const std::vector<double>& weights, std::vector<Rigid<D>>& poses);

/// Returns whether edges that measure rotations determine the rotations of all poses.
template <int D>
bool areRotationsTied(const Problem<D>& problem, const std::vector<double>& weights);

}  // namespace pose_graph
