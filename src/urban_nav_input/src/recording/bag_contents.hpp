// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// Returns the transforms of /tf_static, and for children that it lacks those of /tf whose links stay the same to 1 mm
/// and 0.1 deg throughout the recording: sensors whose places are published again and again. Looks at a thousand
/// messages of /tf, evenly distributed.
urban_nav_ros::StaticTransforms readTransforms(Recording& recording);

}  // namespace urban_nav_input
