// SPDX-License-Identifier: BSD-3-Clause
#include "convert/colour_topic.hpp"

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

namespace topics = urban_nav_ros::topics;

namespace {

constexpr const char* kColourFrame = "colour";

sensor_msgs::CameraInfo colourInfo(const urban_nav_core::RawCamera& camera) {
  urban_nav_core::CameraInfo info;
  const urban_nav_core::Pinhole& pinhole = camera.pinhole;
  info.width = pinhole.width;
  info.height = pinhole.height;
  const auto& k = camera.distortion.coefficients();
  const bool is_equidistant = camera.distortion.isEquidistant();
  info.distortion_model = is_equidistant ? "equidistant" : "rational_polynomial";
  info.D.assign(k.begin(), k.begin() + (is_equidistant ? 4 : 8));
  info.K << pinhole.fx, 0.0, pinhole.cx, 0.0, pinhole.fy, pinhole.cy, 0.0, 0.0, 1.0;
  info.P.leftCols<3>() = info.K;
  return urban_nav_ros::toCameraInfoMessage(info);
}

}  // namespace

std::vector<geometry_msgs::TransformStamped> colourTransforms(const urban_nav_input::SourceInfo& info) {
  if (info.colour_cameras.empty()) return {};
  return {urban_nav_ros::toStaticTransform(urban_nav_core::frames::kBaseLink, kColourFrame,
                                           info.colour_cameras.front().T_base_camera)};
}

void writeColours(const urban_nav_input::SourceItem& item, const urban_nav_input::SourceInfo& info,
                  urban_nav_core::StampNs shift, BagWriter& bag) {
  for (const urban_nav_input::ColourInput& input : item.colours) {
    const sensor_msgs::CompressedImageConstPtr stored = input.image.compressed();
    if (input.camera != 0 || !stored) continue;
    const urban_nav_core::StampNs stamp = input.stamp + shift;
    sensor_msgs::CompressedImage image = *stored;
    image.header.stamp = urban_nav_ros::toRosTime(stamp);
    image.header.frame_id = kColourFrame;
    sensor_msgs::CameraInfo camera = colourInfo(info.colour_cameras.front().camera);
    camera.header = image.header;
    bag.write(topics::fromRoot(topics::kColourImage), stamp, image);
    bag.write(topics::fromRoot(topics::kColourInfo), stamp, camera);
  }
}

}  // namespace urban_nav
