// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

/// Returns the first track whose map contains all of `track`; `track` itself if it was not joined to an earlier one.
std::size_t findMap(const std::vector<Track>& tracks, std::size_t track);

/// Returns T_level_map, which levels a map: its first pose moves to the origin with heading zero. Identity if the
/// upward direction is unknown.
Pose levelling(const Level& level, const Pose& T_map_first);

}  // namespace pose_graph
