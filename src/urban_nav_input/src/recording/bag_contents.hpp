// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// Returns the transforms of /tf_static, and for missing children those of /tf that are constant to 1 mm and 0.1 deg
/// throughout the recording. Reads a thousand evenly distributed messages of /tf.
urban_nav_ros::StaticTransforms readTransforms(Recording& recording);

}  // namespace urban_nav_input
