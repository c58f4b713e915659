// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urban_nav_msgs/DepthView.h>

#include <optional>

#include "urban_nav_core/camera/depth_samples.hpp"

namespace urban_nav_ros {

urban_nav_msgs::DepthView toDepthViewMessage(urban_nav_core::DepthSamples samples, const std_msgs::Header& header);
/// Returns nullopt if the numbers of samples contradict each other or exceed 4 million, or the camera is invalid.
std::optional<urban_nav_core::DepthSamples> toDepthSamples(const urban_nav_msgs::DepthView& message);

}  // namespace urban_nav_ros
