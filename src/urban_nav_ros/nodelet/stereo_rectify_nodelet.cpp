// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include <chrono>
#include <cmath>

#include "urban_nav_ros/sensor_inputs.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/stereo_rectifier.hpp"
#include "urban_nav_ros/stereo_rectify_parameters.hpp"
#include "urban_nav_ros/stereo_topics.hpp"

namespace urban_nav_ros {

/// Publishes stereo/{left,right}/image_rect, so that the stages of a nodelet manager share one decoded and rectified
/// image by pointer.
class StereoRectifyStage {
 public:
  static constexpr const char* name = "stereo_rectify";
  static constexpr const char* topic = "rectified images";
  using Input = std::variant<ImageInput, InfoInput>;
  using Node = StageNodeWith<Input>;

  explicit StereoRectifyStage(Node& node);

  void handle(Input& input) {
    std::visit([this](const auto& message) { rectifier_->handle(message); }, input);
  }
  bool idle() { return false; }
  std::string reset() {
    rectifier_->reset();
    return "waiting images were dropped";
  }
  void finish(std::chrono::milliseconds /*limit*/) {}  // all images so far are published when it is called
  static constexpr int kFinishOrder = -1;              // before the odometry, which receives them
  void close() {}
  urban_nav_live::StageReport report() const { return rectifier_->report(); }

 private:
  ros::Publisher left_, right_;
  std::unique_ptr<StereoRectifier> rectifier_;
};

StereoRectifyStage::StereoRectifyStage(Node& node) {
  for (const auto& [input, output] :
       {std::pair(topics::kLeftImage, topics::kLeftRectified), std::pair(topics::kRightImage, topics::kRightRectified)})
    if (node.nh().resolveName(input) == node.nh().resolveName(output))
      throw urban_nav_core::UserError(input,
                                      "remapped to " + node.nh().resolveName(output) + ", which is published here",
                                      "the topic of the camera");
  const auto parameters = readParameters(node.privateHandle(), stereoRectifyTable());
  node.setQueueSize(parameters.queue_size, parameters.drain_s);
  left_ = node.nh().advertise<sensor_msgs::Image>(topics::kLeftRectified,
                                                  static_cast<std::uint32_t>(parameters.queue_size));
  right_ = node.nh().advertise<sensor_msgs::Image>(topics::kRightRectified,
                                                   static_cast<std::uint32_t>(parameters.queue_size));
  StereoRectifier::Listener listener;
  listener.image = [this](Side side, const sensor_msgs::ImageConstPtr& image) {
    (side == Side::Left ? left_ : right_).publish(image);
  };
  listener.fault = [&node](const std::string& fault) { node.logWarning("fault", fault); };
  StereoRectifier::Options options;
  options.rectified = areRectified(parameters.image_type, node.nh().resolveName(topics::kLeftImage));
  options.judges_images = parameters.image_type == "auto";
  options.right_delay = static_cast<urban_nav_core::StampNs>(
      std::llround(1e6 * readParameters(ros::NodeHandle(node.nh(), "input"), liveCorrectionTable()).right_delay));
  options.queue = parameters.queue_size;
  options.where = node.nh().resolveName("stereo");
  rectifier_ = std::make_unique<StereoRectifier>(options, listener);
  TopicOptions subscription;
  subscription.timeout = 1.0;  // s; the lowest frame rate for odometry is 5 Hz
  subscription.queue = parameters.queue_size;
  subscribeImages(node, subscription, parameters.compressed);
}

class StereoRectifyNodelet : public StageNodelet<StereoRectifyStage> {};

}  // namespace urban_nav_ros

PLUGINLIB_EXPORT_CLASS(urban_nav_ros::StereoRectifyNodelet, nodelet::Nodelet)
