// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/fix_use.hpp"
#include "pose_graph/level.hpp"
#include "pose_graph/problem.hpp"

namespace pose_graph {

/// A position fix at a pose of a graph.
struct PlacedFix {
  int pose = 0;  ///< index in the problem
  /// Antenna position at the time of the fix in the axes of the pose, m.
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();  ///< east, north, up relative to the datum of its part, m
  Eigen::Vector3d sigma = Eigen::Vector3d::Ones();     ///< stated standard deviations, east, north, up, m
  double share = 1.0;                                  ///< share of its information that is independent of other fixes
};

/// The fixes of a connected part of a graph, relative to one datum.
struct FixedPart {
  int first_pose = 0;  ///< first pose of the part
  std::vector<PlacedFix> fixes;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< in the axes of the first pose
  double up_sigma = 0.0;                          ///< rad
};

/// Assigns fixes to poses. `accepted`: the graph with its accepted edges only; `poses`: relaxed. `stamps`, `forces`,
/// `fixes`: per track; the tracks' poses are consecutive. `unplaced` counts fixes more than 0.5 s from a pose, with
/// non-finite values, or with standard deviations that are not positive.
///
/// Errors of satellite navigation are correlated in time: multipath over a minute, orbits and ionosphere over longer
/// times. Of fixes within twice the correlation time `correlation` (s), each contributes information in proportion to
/// the time since the previous one.
std::vector<FixedPart> placeFixes(const Problem<3>& accepted, const std::vector<Rigid<3>>& poses,
                                  const std::vector<std::vector<urban_nav_core::StampNs>>& stamps,
                                  const std::vector<std::vector<SpecificForce>>& forces,
                                  const std::vector<std::vector<PositionFix>>& fixes, double correlation,
                                  std::size_t& unplaced);

}  // namespace pose_graph
