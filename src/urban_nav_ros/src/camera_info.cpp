// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/camera_info.hpp"

#include <algorithm>

namespace urban_nav_ros {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

namespace {

/// Scales a projection from full resolution to a binned one, after cropping to the region of interest.
template <typename Matrix>
void cutAndBin(double x_offset, double y_offset, double binning_x, double binning_y, Matrix& M) {
  M.row(0) -= x_offset * M.row(2);
  M.row(1) -= y_offset * M.row(2);
  M.row(0) /= binning_x;
  M.row(1) /= binning_y;
}

}  // namespace

urban_nav_core::CameraInfo toCameraInfo(const sensor_msgs::CameraInfo& message) {
  urban_nav_core::CameraInfo info;
  info.width = static_cast<int>(message.width);
  info.height = static_cast<int>(message.height);
  info.distortion_model = message.distortion_model;
  info.D = message.D;
  info.K = Eigen::Map<const RowMajor3>(message.K.data());
  info.R = Eigen::Map<const RowMajor3>(message.R.data());
  info.P = Eigen::Map<const RowMajor34>(message.P.data());
  const auto& roi = message.roi;
  const std::uint32_t bin_x = std::max(message.binning_x, 1U), bin_y = std::max(message.binning_y, 1U);
  const bool cut = roi.width > 0 && roi.height > 0;
  if (cut || bin_x > 1 || bin_y > 1) {
    const double x = cut ? roi.x_offset : 0.0, y = cut ? roi.y_offset : 0.0;
    cutAndBin(x, y, bin_x, bin_y, info.K);
    cutAndBin(x, y, bin_x, bin_y, info.P);
    info.width = static_cast<int>((cut ? roi.width : message.width) / bin_x);
    info.height = static_cast<int>((cut ? roi.height : message.height) / bin_y);
  }
  return urban_nav_core::withRawCamera(info);
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
