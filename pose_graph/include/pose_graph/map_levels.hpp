// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

/// The first track in whose map this one lies as a whole: itself where it joined none before it.
std::size_t findMap(const std::vector<Track>& tracks, std::size_t track);

/// What turns a map so that it is level: T_level_map. The map's first pose comes to the origin, its heading to zero.
/// The identity where it is not known which way is up.
Pose levelling(const Level& level, const Pose& T_map_first);

}  // namespace pose_graph
