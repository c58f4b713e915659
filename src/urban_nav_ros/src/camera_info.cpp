// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/camera_info.hpp"

namespace urban_nav_ros {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

urban_nav_core::CameraInfo toCameraInfo(const sensor_msgs::CameraInfo& message) {
  urban_nav_core::CameraInfo info;
  info.width = static_cast<int>(message.width);
  info.height = static_cast<int>(message.height);
  info.distortion_model = message.distortion_model;
  info.D = message.D;
  info.K = Eigen::Map<const RowMajor3>(message.K.data());
  info.R = Eigen::Map<const RowMajor3>(message.R.data());
  info.P = Eigen::Map<const RowMajor34>(message.P.data());
  return info;
}

sensor_msgs::CameraInfo toCameraInfoMessage(const urban_nav_core::CameraInfo& info) {
  sensor_msgs::CameraInfo message;
  message.width = static_cast<std::uint32_t>(info.width);
  message.height = static_cast<std::uint32_t>(info.height);
  message.distortion_model = info.distortion_model;
  message.D = info.D;
  Eigen::Map<RowMajor3>(message.K.data()) = info.K;
  Eigen::Map<RowMajor3>(message.R.data()) = info.R;
  Eigen::Map<RowMajor34>(message.P.data()) = info.P;
  return message;
}

}  // namespace urban_nav_ros
