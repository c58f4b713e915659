// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

namespace urban_nav_ros {

/// Writes labelled points into a cloud: x, y, z, probability (of the label), label, unsure.
class LabelCloud {
 public:
  /// `points`: number that will be added.
  explicit LabelCloud(std::size_t points) : cloud_(withFields(points)) {}
  LabelCloud(const LabelCloud&) = delete;
  LabelCloud& operator=(const LabelCloud&) = delete;

  /// Adds a point with a row of labels that have probability(row), labels[row] and unsure[row].
  template <typename Labels>
  void add(const Eigen::Vector3f& point, const Labels& labels, std::size_t row) {
    for (int axis = 0; axis < 3; ++axis) x_[axis] = point[axis];
    *probability_ = labels.probability(row);
    *label_ = static_cast<std::uint8_t>(labels.labels[row]);
    *unsure_ = labels.unsure[row];
    ++x_, ++probability_, ++label_, ++unsure_;
  }
  sensor_msgs::PointCloud2& message() { return cloud_; }

 private:
  static sensor_msgs::PointCloud2 withFields(std::size_t points) {
    using sensor_msgs::PointField;
    sensor_msgs::PointCloud2 cloud;
    sensor_msgs::PointCloud2Modifier modifier(cloud);
    modifier.setPointCloud2Fields(6, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1,
                                  PointField::FLOAT32, "probability", 1, PointField::FLOAT32, "label", 1,
                                  PointField::UINT8, "unsure", 1, PointField::UINT8);
    modifier.resize(points);
    return cloud;
  }

  sensor_msgs::PointCloud2 cloud_;
  sensor_msgs::PointCloud2Iterator<float> x_{cloud_, "x"}, probability_{cloud_, "probability"};
  sensor_msgs::PointCloud2Iterator<std::uint8_t> label_{cloud_, "label"}, unsure_{cloud_, "unsure"};
};

}  // namespace urban_nav_ros
