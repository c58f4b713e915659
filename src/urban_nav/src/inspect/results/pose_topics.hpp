// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "convert/bag_writer.hpp"
#include "inspect/results/recorded_map.hpp"

namespace urban_nav {

/// Writes odometry and /tf of each pose, the health of odometry when it changes, and the complete path and the
/// extrinsics (/tf_static) at the first pose. The twist is the mean velocity since the previous pose; the covariance of
/// a pose is zero if the store does not have it.
void writePoseTopics(urban_nav_store::Store& store, const RecordedMap& map, BagWriter& recording);

}  // namespace urban_nav
