// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Core>
#include <cstddef>
#include <string_view>
#include <vector>

#include "urban_nav_core/io/cloud/pcd_writer.hpp"
#include "urban_nav_core/laser/sweep.hpp"

namespace urban_nav_ros {

/// Converts points to a cloud with the fields x, y, z (m) and `fourth`. Sets no header.
sensor_msgs::PointCloud2 toPointCloudMessage(const std::vector<Eigen::Vector4f>& points, const char* fourth);

/// Converts points in the binary form of PCD files to a cloud with the same fields. `bytes`: all points, each with its
/// fields without padding. Sets no header. Requires a whole number of points.
sensor_msgs::PointCloud2 toPointCloudMessage(const std::vector<urban_nav_core::PcdField>& fields,
                                             std::string_view bytes);

/// Converts a sweep to a cloud of one row with the fields of the Velodyne driver: x, y, z (m, axes of the sensor),
/// intensity, ring, and time, s relative to `stamp`, which is set in the header. For a range that is not finite x, y
/// and z are not finite either, and the cloud is not dense. Sets no frame.
sensor_msgs::PointCloud2 toSweepMessage(const urban_nav_core::Sweep& sweep, urban_nav_core::StampNs stamp);

}  // namespace urban_nav_ros
