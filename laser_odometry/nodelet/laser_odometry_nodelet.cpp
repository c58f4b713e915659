// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include <tuple>

#include "live/live_laser_odometry.hpp"
#include "live/nodelet_parameters.hpp"
#include "publisher.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/sweep_inputs.hpp"
#include "urban_nav_ros/topics.hpp"

namespace laser_odometry {

using urban_nav_ros::SweepInputs;

namespace {
constexpr double kPointsTimeout = 1.0;  // s; the slowest LiDARs have 5 Hz
}  // namespace

/// Laser odometry on topics, by the clouds of a 3D LiDAR or the scans of a planar laser.
class LaserOdometryStage {
 public:
  static constexpr const char* name = "laser_odometry";
  static constexpr const char* topic = "laser odometry";
  using Input = SweepInputs::Message;
  using Node = urban_nav_ros::StageNodeWith<Input>;

  explicit LaserOdometryStage(Node& node);

  void handle(Input& input) { inputs_->handle(input); }
  bool idle() {
    publisher_->publishMap(*odometry_, newest_);
    return false;
  }
  std::string reset() {
    inputs_->restart();
    odometry_->end("reset");
    return "session ended; the next sweep begins a new one";
  }
  void finish(std::chrono::milliseconds /*limit*/) { inputs_->flush(); }
  static constexpr int kFinishOrder = 0;  // the other stages receive the poses
  void close() {
    if (ros::ok()) inputs_->flush();
  }
  urban_nav_live::StageReport report() const {
    urban_nav_live::StageReport report = odometry_->report();
    inputs_->addTo(report);
    return report;
  }

 private:
  SweepInputs::Listener listener();
  void subscribe(const urban_nav_core::MotionChoice& motion);
  void setFault(const std::string& fault);
  void process(const urban_nav_core::Sweep& sweep, const std::vector<urban_nav_core::MotionInput>& inputs);

  Node& node_;
  NodeletParameters nodelet_;
  Parameters parameters_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<LiveLaserOdometry> odometry_;
  std::unique_ptr<SweepInputs> inputs_;
  urban_nav_core::StampNs newest_ = 0;
};

LaserOdometryStage::LaserOdometryStage(Node& node) : node_(node) {
  std::tie(nodelet_, parameters_) = node.parameters(nodeletTable(), table());
  node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
  publisher_ = std::make_unique<Publisher>(
      node, Publisher::Frames{nodelet_.odom_frame, nodelet_.base_frame, nodelet_.publish_tf});
  odometry_ = std::make_unique<LiveLaserOdometry>(
      parameters_,
      [this](const LaserPose& pose, double process_ms) {
        newest_ = pose.stamp;
        publisher_->publish(pose, odometry_->session(), process_ms);
      },
      nodelet_.planar ? Scanner::Planar : Scanner::Spatial, nodelet_.robot, nodelet_.recording,
      [this](const std::string& text) { node_.logWarning("motion sensor", text); });
  SweepInputs::Options inputs;
  inputs.base_frame = nodelet_.base_frame;
  inputs.clouds.are_deskewed = nodelet_.deskewed;
  inputs.motion = urban_nav_core::toMotionChoice(nodelet_.motion_input);
  inputs.max_lateness = nodelet_.max_lateness;
  inputs.wheel_noise = nodelet_.wheel_noise;
  inputs.gyro_noise = nodelet_.gyro_noise;
  inputs_ = std::make_unique<SweepInputs>(inputs, listener());
  subscribe(inputs.motion);
}

SweepInputs::Listener LaserOdometryStage::listener() {
  SweepInputs::Listener listener;
  listener.place = [this](const auto& T_base_sensor, const std::string& frame) {
    return odometry_->place(T_base_sensor, nodelet_.base_frame, frame);
  };
  listener.sweep = [this](const auto& sweep, const auto& motion) { process(sweep, motion); };
  listener.ended = [this](const std::string& why) { odometry_->end(why); };
  listener.fault = [this](const std::string& fault) { setFault(fault); };
  listener.invalid = [this](const std::string& fault) {
    node_.gate().countInvalid();
    if (!fault.empty()) node_.logWarning("cloud", fault);
  };
  return listener;
}

void LaserOdometryStage::subscribe(const urban_nav_core::MotionChoice& motion) {
  namespace topics = urban_nav_ros::topics;
  const auto forward = [](const auto& message) { return Input(message); };
  urban_nav_ros::TopicOptions transforms;
  transforms.is_monitored = transforms.is_paused = false;
  node_.subscribeInput<tf2_msgs::TFMessage>(topics::kStaticTransforms, transforms, forward);
  urban_nav_ros::TopicOptions options;
  options.timeout = kPointsTimeout;
  options.queue = nodelet_.queue_size;
  if (nodelet_.planar) node_.subscribeInput<sensor_msgs::LaserScan>(topics::kScan, options, forward);
  else node_.subscribeInput<sensor_msgs::PointCloud2>(topics::kPoints, options, forward);
  options.is_monitored = motion.is_required;
  if (motion.wheels) node_.subscribeInput<nav_msgs::Odometry>(topics::kWheelOdometry, options, forward);
  if (motion.gyroscope) node_.subscribeInput<sensor_msgs::Imu>(topics::kImu, options, forward);
}

/// A fault of the units of scans explains why they cannot be read.
void LaserOdometryStage::setFault(const std::string& fault) {
  const std::vector<std::string> units =
      nodelet_.planar && !fault.empty() ? node_.sensors().faults() : std::vector<std::string>();
  odometry_->setFault(units.empty() ? fault : units.front());
}

void LaserOdometryStage::process(const urban_nav_core::Sweep& sweep,
                                 const std::vector<urban_nav_core::MotionInput>& inputs) {
  const std::int64_t before = odometry_->sessions();
  odometry_->process(sweep, inputs);
  if (odometry_->sessions() != before)
    node_.logInfo("session " + std::to_string(odometry_->sessions()) + ": LiDAR " + inputs_->frame());
}

class LaserOdometryNodelet : public urban_nav_ros::StageNodelet<LaserOdometryStage> {};

}  // namespace laser_odometry

PLUGINLIB_EXPORT_CLASS(laser_odometry::LaserOdometryNodelet, nodelet::Nodelet)
