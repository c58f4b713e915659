// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/fix_use.hpp"
#include "pose_graph/level.hpp"
#include "pose_graph/problem.hpp"

namespace pose_graph {

/// A fix at a pose of a graph.
struct PlacedFix {
  int pose = 0;                                        ///< number in the problem
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();     ///< m, of the antenna at the time of the fix, in the
                                                       ///< axes of the pose
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();  ///< m, east, north, up of the datum of its part
  Eigen::Vector3d sigma = Eigen::Vector3d::Ones();     ///< m, east, north, up, as stated
  double share = 1.0;                                  ///< of its information that is independent of the others
};

/// The fixes of a connected part of a graph, which see the part from one datum.
struct FixedPart {
  int first_pose = 0;  ///< of the part
  std::vector<PlacedFix> fixes;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< in the axes of the first pose
  double up_sigma = 0.0;                          ///< rad
};

/// Finds the poses at the times of fixes. `accepted`: the graph with its accepted edges alone; `poses`: relaxed.
/// `stamps`, `forces`, `fixes`: of each track, whose poses stand one after another. Fixes further than 0.5 s from a
/// pose, or with numbers that are not finite, or standard deviations that are not positive, are counted in `unplaced`.
///
/// Errors of satellite navigation last: reflections for a minute, orbits and ionosphere for longer. Of fixes that
/// follow each other within twice the correlation time `correlation`, s, each adds information in proportion to the
/// time since the one before.
std::vector<FixedPart> placeFixes(const Problem<3>& accepted, const std::vector<Rigid<3>>& poses,
                                  const std::vector<std::vector<urban_nav_core::StampNs>>& stamps,
                                  const std::vector<std::vector<SpecificForce>>& forces,
                                  const std::vector<std::vector<PositionFix>>& fixes, double correlation,
                                  std::size_t& unplaced);

}  // namespace pose_graph
