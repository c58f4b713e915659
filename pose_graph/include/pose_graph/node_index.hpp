// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Index of a track and index of a pose in it.
using NodeIndex = std::pair<std::size_t, std::size_t>;

/// One odometry step of a track, as used in relaxation.
struct ChainStep {
  bool joins = true;  ///< false: the chain is broken here and all other members are unused
  Edge<3> edge;       ///< pose numbers are not set
  TangentMatrix<3> covariance = TangentMatrix<3>::Zero();  ///< inverse of the edge's information
  bool slipped = false;  ///< contradicted by closures: `edge` is the motion that they imply, with almost no information
  bool invertible = true;  ///< false: the information is singular, so the step cannot be part of a condensed chain
  /// Covariance of the pose at the end of the step relative to its window (PoseGraph::ownNoise()).
  TangentMatrix<3> own_noise = TangentMatrix<3>::Zero();
};

/// A closure between two nodes.
struct ClosureEdge {
  NodeIndex a, b;
  Edge<3> edge;  ///< pose numbers are not set
};

}  // namespace pose_graph
