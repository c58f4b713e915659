// SPDX-License-Identifier: BSD-3-Clause
#include "messages.hpp"

#include <sensor_msgs/image_encodings.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "urban_nav_ros/point_cloud.hpp"

namespace dense_stereo {

using sensor_msgs::PointField;
using urban_nav_core::StereoCamera;

namespace {

constexpr float kDisparityStep = 0.05F;  // px, about the subpixel accuracy

/// Returns the disparity in px without the offset between the principal points; negative if invalid or not in front.
float plainDisparity(const DisparityImage& image, std::size_t at, float offset) {
  const float disparity = image.disparity[at];
  return disparity < 0.0F ? DisparityImage::kInvalid : disparity - offset;
}

}  // namespace

stereo_msgs::DisparityImage toDisparityMessage(const DisparityImage& image, const StereoCamera& camera, int disparities,
                                               const std_msgs::Header& header) {
  stereo_msgs::DisparityImage message;
  message.header = message.image.header = header;
  message.f = static_cast<float>(camera.left.fx);
  message.T = static_cast<float>(camera.baseline);
  message.min_disparity = 0.0F;
  message.max_disparity = static_cast<float>(disparities - 1);
  message.delta_d = kDisparityStep;
  message.valid_window.width = static_cast<std::uint32_t>(image.width);
  message.valid_window.height = static_cast<std::uint32_t>(image.height);
  message.image.width = message.valid_window.width;
  message.image.height = message.valid_window.height;
  message.image.encoding = sensor_msgs::image_encodings::TYPE_32FC1;
  message.image.step = message.image.width * static_cast<std::uint32_t>(sizeof(float));
  std::vector<float> values(image.disparity.size());
  const auto offset = static_cast<float>(camera.disparity_offset);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float disparity = plainDisparity(image, i, offset);
    values[i] = disparity < 0.0F ? DisparityImage::kInvalid : disparity;
  }
  message.image.data.resize(values.size() * sizeof(float));
  std::memcpy(message.image.data.data(), values.data(), message.image.data.size());
  return message;
}

sensor_msgs::PointCloud2 toPointsMessage(const DisparityImage& image, const StereoCamera& camera,
                                         const urban_nav_core::ImageView& left, const std_msgs::Header& header) {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier fields(cloud);
  fields.setPointCloud2FieldsByString(2, "xyz", "rgb");
  fields.resize(image.disparity.size());
  cloud.header = header;
  cloud.width = static_cast<std::uint32_t>(image.width);
  cloud.height = static_cast<std::uint32_t>(image.height);
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.is_dense = false;
  const float focal = static_cast<float>(camera.left.fx * camera.baseline);
  const auto offset = static_cast<float>(camera.disparity_offset);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  sensor_msgs::PointCloud2Iterator<float> xyz(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> rgb(cloud, "rgb");
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u, ++xyz, ++rgb) {
      const float disparity = plainDisparity(image, image.index(u, v), offset);
      const float z = disparity > 0.0F ? focal / disparity : nan;
      xyz[0] = static_cast<float>((u - camera.left.cx) / camera.left.fx) * z;
      xyz[1] = static_cast<float>((v - camera.left.cy) / camera.left.fy) * z;
      xyz[2] = z;
      for (int c = 0; c < 3; ++c) rgb[c] = left.at(u, v);
    }
  return cloud;
}

urban_nav_msgs::GroundPlane toGroundMessage(const GroundPlane& ground, const std_msgs::Header& header) {
  urban_nav_msgs::GroundPlane message;
  message.header = header;
  message.up.x = ground.up.x();
  message.up.y = ground.up.y();
  message.up.z = ground.up.z();
  message.height = ground.height;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      message.covariance[static_cast<std::size_t>(4 * row + column)] = ground.covariance(row, column);
  message.support = ground.support;
  message.verdict = static_cast<std::uint8_t>(ground.verdict);
  message.message = ground.sentence;
  return message;
}

sensor_msgs::PointCloud2 toObstaclesMessage(const std::vector<ObstaclePoint>& obstacles,
                                            const std_msgs::Header& header) {
  std::vector<Eigen::Vector4f> points;
  points.reserve(obstacles.size());
  for (const ObstaclePoint& obstacle : obstacles)
    points.emplace_back(obstacle.p_cam.x(), obstacle.p_cam.y(), obstacle.p_cam.z(), obstacle.height);
  sensor_msgs::PointCloud2 cloud = urban_nav_ros::toPointCloudMessage(points, "height");
  cloud.header = header;
  return cloud;
}

}  // namespace dense_stereo
