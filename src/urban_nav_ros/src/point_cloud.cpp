// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/point_cloud.hpp"

#include <sensor_msgs/point_cloud2_iterator.h>

namespace urban_nav_ros {

sensor_msgs::PointCloud2 toPointCloudMessage(const std::vector<Eigen::Vector4f>& points, const char* fourth) {
  using sensor_msgs::PointField;
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier fields(cloud);
  fields.setPointCloud2Fields(4, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1, PointField::FLOAT32,
                              fourth, 1, PointField::FLOAT32);
  fields.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> at(cloud, "x");
  for (const Eigen::Vector4f& point : points) {
    for (int i = 0; i < 4; ++i) at[i] = point[i];
    ++at;
  }
  return cloud;
}

}  // namespace urban_nav_ros
