// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/subscriber.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "urban_nav_ros/recorded_image.hpp"
#include "urban_nav_ros/stage_node.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_ros {

/// Subscriptions to the images of a panoramic head, to those of the left camera instead, or to both until it is clear
/// which of them a robot has.
class HeadImages {
 public:
  static constexpr std::size_t kHeadCameras = topics::kPanoramaImages.size();
  struct Options {
    int cameras = 0;  ///< of the head; 1: the left camera; 0: the head and, with the next number, the left camera
    bool compressed = true, left_compressed = false;
    int queue = 100;       ///< messages
    double timeout = 2.0;  ///< s without images after which a camera is silent
  };
  /// Called in a thread of ROS.
  using Take = std::function<void(std::size_t camera, RecordedImage image)>;

  HeadImages(StageNode& node, const Options& options, Take take)
      : node_(node), options_(options), take_(std::move(take)) {
    if (options.compressed) subscribeHead<sensor_msgs::CompressedImage>();
    else subscribeHead<sensor_msgs::Image>();
    if (options.cameras > 0) return;
    if (options.left_compressed) subscribeLeft<sensor_msgs::CompressedImage>();
    else subscribeLeft<sensor_msgs::Image>();
  }
  /// The robot has a head: its images are monitored, and the subscription to the left camera ends.
  void chooseHead() {
    if (options_.cameras > 0) return;  // monitored from the start
    left_.shutdown();
    for (std::size_t camera = 0; camera < kHeadCameras; ++camera) expect(camera);
  }
  /// The robot has no head: images of the left camera are monitored.
  void chooseLeft() { expect(kHeadCameras); }
  void shutDown() { left_.shutdown(); }

 private:
  /// Returns the number of cameras of the head; 1: the left camera instead.
  std::size_t cameras() const {
    return options_.cameras == 0 ? kHeadCameras : static_cast<std::size_t>(options_.cameras);
  }
  template <typename Message>
  using Pointer = boost::shared_ptr<const Message>;

  std::string topic(std::size_t camera) const {
    const bool is_left = options_.cameras == 1 || camera == kHeadCameras;
    const bool is_compressed = camera == kHeadCameras ? options_.left_compressed : options_.compressed;
    return (is_left ? std::string(topics::kLeftImage) : topics::kPanoramaImages[camera]) +
           (is_compressed ? "/compressed" : "");
  }
  void expect(std::size_t camera) { node_.monitor().expect(node_.nh().resolveName(topic(camera)), options_.timeout); }
  template <typename Message>
  void subscribeHead() {
    TopicOptions options;
    options.timeout = options_.timeout;
    options.queue = options_.queue;
    options.is_monitored = options_.cameras > 0;
    for (std::size_t camera = 0; camera < cameras(); ++camera)
      node_.subscribe<Message>(topic(camera), options, [this, camera](const Pointer<Message>& message) {
        take_(camera, RecordedImage(message));
      });
  }
  /// Not by StageNode, whose subscriptions last as long as the stage.
  template <typename Message>
  void subscribeLeft() {
    const boost::function<void(const Pointer<Message>&)> received =
        [this, name = node_.nh().resolveName(topic(kHeadCameras))](const Pointer<Message>& message) {
          node_.monitor().received(name, toStampNs(message->header.stamp));
          if (node_.gate().pass()) take_(kHeadCameras, RecordedImage(message));
        };
    left_ = node_.nh().subscribe<Message>(topic(kHeadCameras), static_cast<std::uint32_t>(options_.queue), received);
  }

  StageNode& node_;
  const Options options_;
  const Take take_;
  ros::Subscriber left_;
};

}  // namespace urban_nav_ros
