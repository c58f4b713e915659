// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "convert/bag_writer.hpp"
#include "inspect/results/recorded_map.hpp"

namespace urban_nav {

/// Writes odometry and /tf of each pose, the health of odometry where it changes, and the whole path and the places of
/// the sensors (/tf_static) at the first pose. The twist is the mean velocity since the pose before; the covariance of
/// a pose is zero in stores that do not hold it.
void writePoseTopics(urban_nav_store::Store& store, const RecordedMap& map, BagWriter& recording);

}  // namespace urban_nav
