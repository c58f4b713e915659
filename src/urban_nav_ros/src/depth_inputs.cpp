// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/depth_inputs.hpp"

#include <algorithm>
#include <utility>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/depth_image.hpp"

namespace urban_nav_ros {

DepthCalibration toDepthCalibration(const sensor_msgs::CameraInfo& message, const std::string& topic) {
  const urban_nav_core::CameraInfo info = urban_nav_core::withRawCamera(toCameraInfo(message));
  return {urban_nav_core::rawCamera(info, topic).pinhole, urban_nav_core::needsRectification(info)};
}

void DepthInputs::handle(const DepthMessage& message) {
  if (message.camera >= cameras_.size()) cameras_.resize(message.camera + 1);
  if (const auto* info = std::get_if<sensor_msgs::CameraInfoConstPtr>(&message.message)) addInfo(message.camera, *info);
  else if (const auto* image = std::get_if<sensor_msgs::ImageConstPtr>(&message.message))
    addImage(message.camera, *image);
  else addImage(message.camera, std::get<sensor_msgs::CompressedImageConstPtr>(message.message));
}

void DepthInputs::addInfo(std::size_t number, const sensor_msgs::CameraInfoConstPtr& info) {
  Camera& camera = cameras_[number];
  if (camera.info && camera.info->K == info->K && camera.info->P == info->P && camera.info->width == info->width &&
      camera.info->height == info->height)
    return;
  camera.info = info;
  try {
    camera.calibration = toDepthCalibration(*info, topics::kDepthInfos.at(number));
    camera.calibration_fault.clear();
  } catch (const urban_nav_core::UserError& error) {
    camera.calibration_fault = error.what();
    camera.calibration.reset();
  }
}

template <typename Message>
void DepthInputs::addImage(std::size_t number, const boost::shared_ptr<const Message>& message) {
  Camera& camera = cameras_[number];
  if (!camera.calibration) {
    ++camera.uncalibrated;
    return;
  }
  const auto decode = [this, number, message,
                       size = cv::Size(camera.calibration->pinhole.width, camera.calibration->pinhole.height)] {
    DepthPixels pixels = toDepth(*message);
    if (pixels.fault.empty() && pixels.depth.size() != size)
      pixels = {{},
                "images have " + std::to_string(pixels.depth.cols) + "x" + std::to_string(pixels.depth.rows) +
                    " pixels, " + topics::kDepthInfos.at(number) + " is of " + std::to_string(size.width) + "x" +
                    std::to_string(size.height)};
    cameras_[number].image_fault = pixels.fault;
    return pixels.depth;
  };
  listener_({message->header.frame_id, toStampNs(message->header.stamp), camera.calibration->pinhole, decode});
}

std::string DepthInputs::fault() const {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const Camera& camera = cameras_[i];
    const std::string topic = topics::kDepthImages.at(i);
    if (!camera.calibration_fault.empty()) return camera.calibration_fault;
    if (!camera.image_fault.empty()) return topic + ": " + camera.image_fault;
    if (!camera.calibration && camera.uncalibrated > 0)
      return std::to_string(camera.uncalibrated) + " images on " + topic + ", but nothing on " +
             topics::kDepthInfos.at(i);
  }
  return {};
}

void DepthInputs::addTo(urban_nav_live::StageReport& report) const {
  for (std::size_t i = 0; i < cameras_.size(); ++i)
    if (cameras_[i].calibration && cameras_[i].calibration->is_distorted)
      report.warn(std::string(topics::kDepthImages.at(i)) + ": the distortion in " + topics::kDepthInfos.at(i) +
                  " is not corrected in depth images");
}

}  // namespace urban_nav_ros
