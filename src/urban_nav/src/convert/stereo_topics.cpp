// SPDX-License-Identifier: BSD-3-Clause
#include "convert/stereo_topics.hpp"

#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

namespace frames = urban_nav_core::frames;

using urban_nav_core::StampNs;

namespace {

void writeSide(const char* image_topic, const char* info_topic, const std::string& frame,
               const urban_nav_core::ImageView& view, StampNs stamp, const urban_nav_core::CameraInfo& info,
               BagWriter& bag) {
  if (view.empty()) return;
  auto* bytes = const_cast<std::uint8_t*>(view.data);  // cv::Mat has no const view; it is only read
  sensor_msgs::Image image = urban_nav_ros::toImageMessage(
      cv::Mat(view.height, view.width, CV_8UC1, bytes, static_cast<std::size_t>(view.stride)));
  image.header.stamp = urban_nav_ros::toRosTime(stamp);
  image.header.frame_id = frame;
  sensor_msgs::CameraInfo camera = urban_nav_ros::toCameraInfoMessage(info);
  camera.header = image.header;
  bag.write(urban_nav_ros::topics::fromRoot(image_topic), stamp, image);
  bag.write(urban_nav_ros::topics::fromRoot(info_topic), stamp, camera);
}

}  // namespace

void writeStereo(const urban_nav_core::StereoPair& pair, StampNs stamp, const urban_nav_core::StereoCamera& camera,
                 BagWriter& bag) {
  writeSide(urban_nav_ros::topics::kLeftImage, urban_nav_ros::topics::kLeftInfo, frames::kStereoLeft, pair.left, stamp,
            urban_nav_core::leftInfo(camera), bag);
  writeSide(urban_nav_ros::topics::kRightImage, urban_nav_ros::topics::kRightInfo, frames::kStereoRight, pair.right,
            stamp, urban_nav_core::rightInfo(camera), bag);
}

std::vector<geometry_msgs::TransformStamped> stereoTransforms(const urban_nav_core::StereoCamera& camera,
                                                              const urban_nav_core::Pose& T_base_left) {
  const urban_nav_core::Pose T_left_right(urban_nav_core::Quaterniond::Identity(),
                                          urban_nav_core::Vector3d(camera.baseline, 0.0, 0.0));
  return {urban_nav_ros::toStaticTransform(frames::kBaseLink, frames::kStereoLeft, T_base_left),
          urban_nav_ros::toStaticTransform(frames::kStereoLeft, frames::kStereoRight, T_left_right)};
}

}  // namespace urban_nav
