// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_ros/grey_range.hpp"

namespace urban_nav_input {

/// Returns the common range of the 16-bit pixels of cameras, from the first images of each topic.
urban_nav_ros::GreyRange surveyGreyRange(Recording& recording, const std::vector<std::string>& topics);

}  // namespace urban_nav_input
