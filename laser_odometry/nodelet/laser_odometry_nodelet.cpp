// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <tuple>
#include <variant>

#include "live/live_laser_odometry.hpp"
#include "live/nodelet_parameters.hpp"
#include "publisher.hpp"
#include "urban_nav_core/laser/planar_sweep.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/sweep_feed.hpp"
#include "urban_nav_ros/topics.hpp"

namespace laser_odometry {

namespace {
constexpr double kPointsTimeout = 1.0;  // s; the slowest LiDARs have 5 Hz
}  // namespace

/// Laser odometry on topics, by the clouds of a 3D LiDAR or the scans of a planar laser.
class LaserOdometryStage {
 public:
  static constexpr const char* name = "laser_odometry";
  static constexpr const char* topic = "laser odometry";
  using Input =
      std::variant<tf2_msgs::TFMessageConstPtr, sensor_msgs::PointCloud2ConstPtr, sensor_msgs::LaserScanConstPtr>;
  using Node = urban_nav_ros::StageNodeWith<Input>;

  explicit LaserOdometryStage(Node& node);

  void handle(Input& input);
  bool idle() {
    publisher_->publishMap(*odometry_, newest_);
    return false;
  }
  std::string reset() {
    odometry_->end("reset");
    return "session ended; the next sweep begins a new one";
  }
  void close() {}
  urban_nav_live::StageReport report() const { return odometry_->report(); }

 private:
  void subscribe();
  void add(const sensor_msgs::PointCloud2ConstPtr& cloud);
  void add(const sensor_msgs::LaserScanConstPtr& message);
  void begin(const std::string& frame);
  bool place();
  void process(const urban_nav_core::Sweep& sweep);

  Node& node_;
  NodeletParameters nodelet_;
  Parameters parameters_;
  urban_nav_core::CloudOptions clouds_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<LiveLaserOdometry> odometry_;
  std::unique_ptr<urban_nav_ros::SweepFeed> feed_;
  urban_nav_core::PlanarSweepReader scans_;
  urban_nav_ros::StaticTransforms transforms_;
  std::string frame_;  ///< frame of the sensor
  urban_nav_core::StampNs newest_ = 0;
};

LaserOdometryStage::LaserOdometryStage(Node& node) : node_(node) {
  std::tie(nodelet_, parameters_) = node.parameters(nodeletTable(), table());
  node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
  clouds_.are_deskewed = nodelet_.deskewed;
  publisher_ = std::make_unique<Publisher>(
      node, Publisher::Frames{nodelet_.odom_frame, nodelet_.base_frame, nodelet_.publish_tf});
  odometry_ = std::make_unique<LiveLaserOdometry>(
      parameters_,
      [this](const LaserPose& pose, double process_ms) {
        newest_ = pose.stamp;
        publisher_->publish(pose, odometry_->session(), process_ms);
      },
      nodelet_.planar ? Scanner::Planar : Scanner::Spatial, nodelet_.robot, nodelet_.recording);
  subscribe();
}

void LaserOdometryStage::subscribe() {
  urban_nav_ros::TopicOptions transforms;
  transforms.is_monitored = transforms.is_paused = false;
  node_.subscribeInput<tf2_msgs::TFMessage>(urban_nav_ros::topics::kStaticTransforms, transforms,
                                            [](const tf2_msgs::TFMessageConstPtr& message) { return message; });
  urban_nav_ros::TopicOptions options;
  options.timeout = kPointsTimeout;
  options.queue = nodelet_.queue_size;
  if (nodelet_.planar)
    node_.subscribeInput<sensor_msgs::LaserScan>(urban_nav_ros::topics::kScan, options,
                                                 [](const sensor_msgs::LaserScanConstPtr& message) { return message; });
  else
    node_.subscribeInput<sensor_msgs::PointCloud2>(
        urban_nav_ros::topics::kPoints, options,
        [](const sensor_msgs::PointCloud2ConstPtr& message) { return message; });
}

void LaserOdometryStage::handle(Input& input) {
  if (const auto* transforms = std::get_if<tf2_msgs::TFMessageConstPtr>(&input)) transforms_.add(**transforms);
  else if (const auto* scan = std::get_if<sensor_msgs::LaserScanConstPtr>(&input)) add(*scan);
  else add(std::get<sensor_msgs::PointCloud2ConstPtr>(input));
}

void LaserOdometryStage::begin(const std::string& frame) {
  odometry_->end("another LiDAR: frame " + frame);
  frame_ = frame;
  feed_ = std::make_unique<urban_nav_ros::SweepFeed>(clouds_);
  scans_ = {};
}

bool LaserOdometryStage::place() {
  return odometry_->place(transforms_.lookup(nodelet_.base_frame, frame_), nodelet_.base_frame, frame_);
}

void LaserOdometryStage::process(const urban_nav_core::Sweep& sweep) {
  const std::int64_t before = odometry_->sessions();
  odometry_->process(sweep);
  if (odometry_->sessions() != before)
    node_.logInfo("session " + std::to_string(odometry_->sessions()) + ": LiDAR " + frame_);
}

void LaserOdometryStage::add(const sensor_msgs::LaserScanConstPtr& message) {
  if (!feed_ || message->header.frame_id != frame_) begin(message->header.frame_id);
  if (!place()) return;
  const std::optional<urban_nav_core::PlanarScan> scan = urban_nav_ros::toPlanarScan(*message, {});
  const std::vector<std::string> faults = node_.sensors().faults();
  odometry_->setFault(scan ? "" : faults.empty() ? "scans without a stamp or angles of beams" : faults.front());
  if (scan) process(scans_.read(*scan));
  else node_.gate().countInvalid();
}

void LaserOdometryStage::add(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  if (!feed_ || cloud->header.frame_id != frame_) begin(cloud->header.frame_id);
  if (!place()) return;
  const std::vector<urban_nav_core::ReadSweep> sweeps = feed_->add(cloud);
  odometry_->setFault(feed_->fault());
  for (const urban_nav_core::ReadSweep& read : sweeps) {
    if (!read.fault.empty()) {
      node_.gate().countInvalid();
      node_.logWarning("cloud", read.fault);
      continue;
    }
    process(read.sweep);
  }
}

class LaserOdometryNodelet : public urban_nav_ros::StageNodelet<LaserOdometryStage> {};

}  // namespace laser_odometry

PLUGINLIB_EXPORT_CLASS(laser_odometry::LaserOdometryNodelet, nodelet::Nodelet)
