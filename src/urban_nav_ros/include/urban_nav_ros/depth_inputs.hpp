// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "urban_nav_core/camera/pinhole.hpp"
#include "urban_nav_live/stage_report.hpp"
#include "urban_nav_ros/stage_node.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_ros {

/// Message of a depth camera.
struct DepthMessage {
  std::size_t camera = 0;  ///< index in topics::kDepthImages
  std::variant<sensor_msgs::CameraInfoConstPtr, sensor_msgs::ImageConstPtr, sensor_msgs::CompressedImageConstPtr>
      message;
};

/// Camera of depth images: a pinhole, and whether its camera_info has a distortion, which is not corrected.
struct DepthCalibration {
  urban_nav_core::Pinhole pinhole;
  bool is_distorted = false;
};

/// Returns the calibration of depth images. Throws UserError naming `topic` if it is not that of a camera.
DepthCalibration toDepthCalibration(const sensor_msgs::CameraInfo& message, const std::string& topic);

/// Converts the messages of live depth cameras: images wait for a calibration, and are decoded on demand. Used by one
/// thread.
class DepthInputs {
 public:
  /// Returns depths (CV_32FC1, m along the optical axis; 0: none); empty: the image cannot be decoded.
  using Decode = std::function<cv::Mat()>;
  struct Image {
    std::string frame;  ///< optical frame
    urban_nav_core::StampNs stamp = 0;
    urban_nav_core::Pinhole pinhole;
    Decode decode;  ///< valid until the DepthInputs is destroyed
  };
  using Listener = std::function<void(const Image&)>;

  explicit DepthInputs(Listener listener) : listener_(std::move(listener)) {}

  void handle(const DepthMessage& message);
  /// Returns why images of a camera are not used; empty: all are used.
  std::string fault() const;
  /// Adds warnings on cameras that are used.
  void addTo(urban_nav_live::StageReport& report) const;

 private:
  struct Camera {
    sensor_msgs::CameraInfoConstPtr info;  ///< source of the calibration; null before the first one
    std::optional<DepthCalibration> calibration;
    std::string calibration_fault, image_fault;
    std::int64_t uncalibrated = 0;  ///< images before the first camera_info
  };

  void addInfo(std::size_t camera, const sensor_msgs::CameraInfoConstPtr& info);
  template <typename Message>
  void addImage(std::size_t camera, const boost::shared_ptr<const Message>& message);

  const Listener listener_;
  std::vector<Camera> cameras_;
};

/// Subscribes to `cameras` depth cameras as inputs of a stage, none of which is required. Images are thinned to ten a
/// second, since those that wait for the stage occupy memory. Requires that Input is constructible from DepthMessage.
/// `compressed`: the images are of compressed_depth_image_transport.
template <typename Input>
void subscribeDepth(StageNodeWith<Input>& node, std::size_t cameras, bool compressed) {
  constexpr urban_nav_core::StampNs kLeastInterval = 90'000'000;  // ns: ten a second of a camera with 30
  TopicOptions options;
  options.is_monitored = false;
  options.queue = 5;
  for (std::size_t camera = 0; camera < cameras; ++camera) {
    node.template subscribeInput<sensor_msgs::CameraInfo>(topics::kDepthInfos.at(camera), options,
                                                          [camera](const sensor_msgs::CameraInfoConstPtr& message) {
                                                            return Input(DepthMessage{camera, message});
                                                          });
    const auto push = [&node, camera,
                       last = std::make_shared<std::atomic<urban_nav_core::StampNs>>(0)](const auto& message) {
      const urban_nav_core::StampNs stamp = toStampNs(message->header.stamp), since = stamp - last->load();
      if (since >= 0 && since < kLeastInterval) return;
      last->store(stamp);
      node.push(Input(DepthMessage{camera, message}));
    };
    const std::string topic = topics::kDepthImages.at(camera);
    if (compressed) node.template subscribe<sensor_msgs::CompressedImage>(topic, options, push);
    else node.template subscribe<sensor_msgs::Image>(topic, options, push);
  }
}

}  // namespace urban_nav_ros
