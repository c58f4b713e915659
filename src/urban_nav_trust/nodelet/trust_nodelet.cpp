// SPDX-License-Identifier: BSD-3-Clause
#include <diagnostic_msgs/DiagnosticArray.h>
#include <nav_msgs/Odometry.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/Trust.h>
#include <urban_nav_msgs/VoStatistics.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

#include "health_markers.hpp"
#include "live/live_trust.hpp"
#include "live/nodelet_parameters.hpp"
#include "trust_message.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/status.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_trust {

namespace topics = urban_nav_ros::topics;

namespace {

constexpr double kOdometryTimeout = 1.0;  // s

std::optional<LiveFrame> toFrame(const urban_nav_msgs::VoStatistics& message) {
  const std::optional<urban_nav_core::Health> health = urban_nav_ros::toHealth(message.status);
  if (!health) return std::nullopt;
  LiveFrame frame;
  frame.stamp = frame.compared.stamp = urban_nav_ros::toStampNs(message.header.stamp);
  frame.accepted = message.accepted != 0;
  frame.health = *health;
  frame.compared.disparity_step_px = message.disparity_step_px;
  frame.compared.disparity_step_sigma_px = message.disparity_step_sigma_px;
  frame.compared.reprojection_px = message.reprojection_px;
  frame.compared.right_turn = Eigen::Vector3d(message.right_turn.data());
  frame.compared.turn = Eigen::Vector3d(message.turn.data());
  frame.compared.turn_error = Eigen::Vector3d(message.turn_error.data());
  frame.compared.turn_sigma = message.turn_sigma;
  frame.compared.forward = message.forward;
  frame.compared.sideways = message.sideways;
  frame.compared.forward_error = message.forward_error;
  frame.compared.forward_sigma = message.forward_sigma;
  frame.compared.imu_delay = message.imu_delay;
  frame.compared.imu_delay_sigma = message.imu_delay_sigma;
  frame.compared.wheel_delay = message.wheel_delay;
  frame.compared.wheel_delay_sigma = message.wheel_delay_sigma;
  frame.compared.gyroscope_fault = message.gyroscope_fault;
  frame.compared.wheels_fault = message.wheels_fault;
  return frame;
}

std::optional<LivePose> toLivePose(const nav_msgs::Odometry& message) {
  const std::optional<urban_nav_core::Pose> pose = urban_nav_ros::toPose(message.pose.pose);
  if (!pose) return std::nullopt;
  return LivePose{urban_nav_ros::toStampNs(message.header.stamp),
                  {*pose, urban_nav_ros::toMatrix6(message.pose.covariance)}};
}

std::optional<LiveStep> toLiveStep(const urban_nav_msgs::RelativePose& message) {
  std::optional<urban_nav_core::RelativePose> step = urban_nav_ros::toRelativePose(message);
  if (!step) return std::nullopt;
  return LiveStep{step->to, std::move(*step)};
}

}  // namespace

/// Consistency tests on topics.
class TrustStage {
 public:
  static constexpr const char* name = "trust";
  static constexpr const char* topic = "trust";
  using Input = std::variant<LiveFrame, LivePose, LiveStep>;
  using Node = urban_nav_ros::StageNodeWith<Input>;

  explicit TrustStage(Node& node) : node_(node) {
    std::tie(nodelet_, parameters_) = node.parameters(nodeletTable(), table());
    node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
    publisher_ = node.nh().advertise<urban_nav_msgs::Trust>(topics::kTrustState, 10, true);
    trust_ = std::make_unique<LiveTrust>(parameters_, [this](const LiveEstimate& estimate) {
      publisher_.publish(toMessage(estimate, parameters_, nodelet_.map_frame));
    });
    urban_nav_ros::TopicOptions options;
    options.queue = nodelet_.queue_size;
    options.is_paused = false;
    options.timeout = kOdometryTimeout;
    node.subscribeInput<nav_msgs::Odometry>(topics::kOdometry, options,
                                            [](const auto& message) { return toLivePose(*message); });
    options.is_monitored = false;
    node.subscribeInput<urban_nav_msgs::VoStatistics>(topics::kVoStatistics, options,
                                                      [](const auto& message) { return toFrame(*message); });
    node.subscribeInput<urban_nav_msgs::RelativePose>(topics::kRelativePose, options,
                                                      [](const auto& message) { return toLiveStep(*message); });
    marker_publisher_ = node.nh().advertise<visualization_msgs::MarkerArray>(topics::kTrustMarkers, 10, true);
    node.subscribe<diagnostic_msgs::DiagnosticArray>(
        topics::results::kDiagnostics, options,
        [this](const diagnostic_msgs::DiagnosticArrayConstPtr& message) { show(*message); });
  }

  void handle(Input& input) {
    std::visit(
        [this](const auto& item) {
          trust_->add(item);
          const urban_nav_core::Status status = trust_->status();
          node_.publishStatus(status, toString(static_cast<Reason>(status.reason)), item.stamp);
        },
        input);
  }
  bool idle() { return false; }
  std::string reset() {
    trust_->reset();
    return "the tests were restarted";
  }
  void close() {}
  urban_nav_live::StageReport report() const { return trust_->report(); }

 private:
  /// Shows the health of all nodes in rviz. Called in a thread of ROS.
  void show(const diagnostic_msgs::DiagnosticArray& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const double now = message.header.stamp.toSec();
    for (const diagnostic_msgs::DiagnosticStatus& status : message.status)
      health_.add(status.name, status.level, status.message, now);
    const StageHealth::Text text = health_.text(now);
    if (text.lines == shown_) return;
    shown_ = text.lines;
    marker_publisher_.publish(toMarkers(text));
  }

  Node& node_;
  NodeletParameters nodelet_;
  Parameters parameters_;
  ros::Publisher publisher_, marker_publisher_;
  std::unique_ptr<LiveTrust> trust_;
  std::mutex mutex_;  // of the members below
  StageHealth health_;
  std::string shown_;
};

class TrustNodelet : public urban_nav_ros::StageNodelet<TrustStage> {};

}  // namespace urban_nav_trust

PLUGINLIB_EXPORT_CLASS(urban_nav_trust::TrustNodelet, nodelet::Nodelet)
