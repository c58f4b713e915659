// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Core>
#include <vector>

namespace urban_nav_ros {

/// Converts points to a cloud with the fields x, y, z (m) and `fourth`. Sets no header.
sensor_msgs::PointCloud2 toPointCloudMessage(const std::vector<Eigen::Vector4f>& points, const char* fourth);

}  // namespace urban_nav_ros
