// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Moves each part of a graph as a whole to where its positions fit best what edges from fixed poses measure of them
/// (Umeyama, least-squares estimation of transformation parameters, PAMI 1991, without scale), each by its information.
/// A part: poses that edges join without leading over a fixed pose. One is left where it is if such an edge measures
/// its rotation as well, or if fewer than two measure its positions. `weights` as in cost().
template <int D>
void alignWithFixed(const Problem<D>& problem, const std::vector<double>& weights, std::vector<Rigid<D>>& poses);

/// Whether the rotations of all poses follow from edges that measure rotations.
template <int D>
bool areRotationsTied(const Problem<D>& problem, const std::vector<double>& weights);

}  // namespace pose_graph
