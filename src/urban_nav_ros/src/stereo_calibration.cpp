// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/stereo_calibration.hpp"

namespace urban_nav_ros {

using urban_nav_core::CameraInfo;
using urban_nav_core::ImageView;
using urban_nav_core::Pose;
using urban_nav_core::RectifyMap;

namespace {

// A driver that does not rectify leaves R zero.
Eigen::Matrix3d toRotation(const CameraInfo& info) {
  return info.R.isZero() ? Eigen::Matrix3d::Identity().eval() : info.R;
}

RectifyMap makeRectifyMap(const CameraInfo& info, const std::string& where) {
  return RectifyMap(rawCamera(info, where), toRotation(info), rectifiedPinhole(info, where));
}

}  // namespace

bool areRectified(const std::string& images, const std::string& topic) {
  return images == "rectified" || (images == "auto" && topic.find("rect") != std::string::npos);
}

StereoCalibration::StereoCalibration(const CameraInfo& left, const CameraInfo& right, bool images_are_rectified,
                                     const std::string& where)
    : camera_(stereoCamera(left, right, where)),
      T_optical_rectified_(Pose(toRotation(left), Eigen::Vector3d::Zero()).inverse()),
      raw_width_(left.width),
      raw_height_(left.height) {
  if (images_are_rectified || !(needsRectification(left) || needsRectification(right))) return;
  left_map_.emplace(makeRectifyMap(left, where + ", left"));
  right_map_.emplace(makeRectifyMap(right, where + ", right"));
}

ImageView StereoCalibration::rectify(Side side, const ImageView& image, std::vector<std::uint8_t>& out) const {
  if (rectifies()) return (side == Side::Left ? left_map_ : right_map_)->remap(image, out);
  if (image.width != camera_.left.width || image.height != camera_.left.height) return {};
  return image;
}

}  // namespace urban_nav_ros
