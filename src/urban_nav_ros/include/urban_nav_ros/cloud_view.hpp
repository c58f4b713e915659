// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <string>

#include "urban_nav_core/laser/cloud/cloud_view.hpp"

namespace urban_nav_ros {

/// Returns a view of a message, which must outlive it. The bytes are not validated; see CloudPoints.
urban_nav_core::CloudView toCloudView(const sensor_msgs::PointCloud2& message);
/// Returns the message of a view, with its stamp, fields and bytes.
sensor_msgs::PointCloud2 toCloudMessage(const urban_nav_core::CloudView& view, const std::string& frame);

}  // namespace urban_nav_ros
