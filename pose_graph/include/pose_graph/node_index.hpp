// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// A pose by the number of its track and its own in there.
using NodeIndex = std::pair<std::size_t, std::size_t>;

/// One step of a track's odometry, as relaxation needs it.
struct ChainStep {
  bool joins = true;  ///< false: the chain is broken here; the rest is nothing then
  Edge<3> edge;       ///< but for its numbers
  TangentMatrix<3> covariance = TangentMatrix<3>::Zero();  ///< inverse of its information
  bool slipped = false;    ///< closures contradict it: `edge` is the motion they give, with next to no information
  bool invertible = true;  ///< whether there is one: else the step is no link of a chain
  TangentMatrix<3> own_noise = TangentMatrix<3>::Zero();  ///< of the pose it ends at (PoseGraph::ownNoise)
};

/// A closure between two places.
struct ClosureEdge {
  NodeIndex a, b;
  Edge<3> edge;  ///< but for its numbers
};

}  // namespace pose_graph
