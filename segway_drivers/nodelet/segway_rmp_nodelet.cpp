// SPDX-License-Identifier: BSD-3-Clause
#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/BatteryState.h>
#include <std_srvs/SetBool.h>
#include <tf2_ros/transform_broadcaster.h>
#include <pluginlib/class_list_macros.hpp>

#include <cmath>
#include <limits>
#include <optional>

#include "driver_nodelet.hpp"
#include "segway_drivers/driver/driver_options.hpp"
#include "urban_nav_ros/topics.hpp"

namespace segway_drivers {

namespace {

constexpr double kOdometryVariancePerMetre = 0.0025;  // m^2/m and rad^2/m: 5 % of a metre
constexpr double kUnmeasured = 1e6;

}  // namespace

/// Base: subscribes to `cmd_vel`; publishes `wheel_odom` and `battery`; service ~emergency_stop (true stops, false
/// releases).
class SegwayRmpNodelet : public DriverNodelet {
 public:
  ~SegwayRmpNodelet() override { shutDown(); }

 private:
  std::string device() const override { return "segway_rmp"; }

  std::unique_ptr<DriverCore> makeDriver(const Parameters& parameters) override {
    frame_ = frameOr("odom");
    odometry_ = getNodeHandle().advertise<nav_msgs::Odometry>(urban_nav_ros::topics::kWheelOdometry, 100);
    battery_ = getNodeHandle().advertise<sensor_msgs::BatteryState>(urban_nav_ros::topics::kBattery, 1, true);
    auto driver = std::make_unique<RmpDriver>(toRmpOptions(parameters));
    driver->on_frame = [this](const RmpStampedFrame& frame) { take(frame); };
    driver_ = driver.get();
    command_ = getNodeHandle().subscribe<geometry_msgs::Twist>(
        urban_nav_ros::topics::kVelocityCommand, 1, [this](const geometry_msgs::TwistConstPtr& twist) {
          const std::lock_guard<std::mutex> guard(wish_mutex_);
          wish_ = {{twist->linear.x, twist->angular.z}, steadyTime()};
        });
    stop_service_ = getPrivateNodeHandle().advertiseService<std_srvs::SetBool::Request, std_srvs::SetBool::Response>(
        "emergency_stop", [this](std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
          const std::lock_guard<std::mutex> guard(wish_mutex_);
          stop_wish_ = request.data != 0;
          response.success = true;
          response.message =
              request.data != 0 ? "the base stays stopped until the stop is released" : "the stop is released";
          return true;
        });
    return driver;
  }

  /// The reading thread also sends: it takes the latest command, which the guard limits.
  void beforeStep(TimeNs) override {
    const std::lock_guard<std::mutex> guard(wish_mutex_);
    if (wish_) driver_->guard().setWish(wish_->first, wish_->second);
    wish_.reset();
    if (stop_wish_ && *stop_wish_) driver_->guard().emergencyStop();
    if (stop_wish_ && !*stop_wish_) driver_->guard().releaseStop();
    stop_wish_.reset();
  }

  void take(const RmpStampedFrame& stamped) {
    const auto values = decodeRmpValues(stamped.frame);
    if (stamped.frame.id == 0x402) {
      speed_ = 0.5 * (*(*values)[0] + *(*values)[1]);
      yaw_rate_ = *(*values)[2];
      publishTimeReference(frame_, stamped.arrival, *(*values)[3]);
    }
    if (stamped.frame.id == 0x406) voltage_ = *(*values)[3];
    if (stamped.frame.id != 0x407 || !stamped.stamp) return;
    publishOdometry(toRos(*stamped.stamp));
    if (*stamped.stamp - last_battery_ < 1'000'000'000) return;
    last_battery_ = *stamped.stamp;
    sensor_msgs::BatteryState battery;
    battery.header.stamp = toRos(*stamped.stamp);
    battery.voltage = static_cast<float>(voltage_);
    battery.current = battery.charge = battery.capacity = battery.design_capacity = battery.percentage =
        std::numeric_limits<float>::quiet_NaN();
    battery.present = 1;
    publish([this, battery] { battery_.publish(battery); });
  }

  void publishOdometry(const ros::Time& stamp) {
    const RmpOdometry& base = driver_->odometry();
    nav_msgs::Odometry odometry;
    odometry.header.stamp = stamp;
    odometry.header.frame_id = frame_;
    odometry.child_frame_id = nodelet().base_frame;
    odometry.pose.pose.position.x = base.x();
    odometry.pose.pose.position.y = base.y();
    odometry.pose.pose.orientation.w = std::cos(0.5 * base.yaw());
    odometry.pose.pose.orientation.z = std::sin(0.5 * base.yaw());
    odometry.twist.twist.linear.x = speed_;
    odometry.twist.twist.angular.z = yaw_rate_;
    for (const std::size_t i : {0U, 7U, 35U})
      odometry.pose.covariance[i] = 1e-6 + kOdometryVariancePerMetre * base.distance();
    for (const std::size_t i : {14U, 21U, 28U})
      odometry.pose.covariance[i] = odometry.twist.covariance[i] = kUnmeasured;
    for (const std::size_t i : {0U, 7U, 35U}) odometry.twist.covariance[i] = 1e-3;
    publish([this, odometry] {
      odometry_.publish(odometry);
      if (!nodelet().publish_tf) return;
      geometry_msgs::TransformStamped transform;
      transform.header = odometry.header;
      transform.child_frame_id = odometry.child_frame_id;
      transform.transform.translation.x = odometry.pose.pose.position.x;
      transform.transform.translation.y = odometry.pose.pose.position.y;
      transform.transform.rotation = odometry.pose.pose.orientation;
      broadcaster_.sendTransform(transform);
    });
  }

  std::string frame_;
  RmpDriver* driver_ = nullptr;  // owned by the base class
  ros::Publisher odometry_, battery_;
  ros::Subscriber command_;
  ros::ServiceServer stop_service_;
  tf2_ros::TransformBroadcaster broadcaster_;
  double speed_ = 0.0, yaw_rate_ = 0.0, voltage_ = 0.0;
  TimeNs last_battery_ = 0;

  std::mutex wish_mutex_;  // guards the following members
  std::optional<std::pair<RmpCommand, TimeNs>> wish_;
  std::optional<bool> stop_wish_;
};

}  // namespace segway_drivers

PLUGINLIB_EXPORT_CLASS(segway_drivers::SegwayRmpNodelet, nodelet::Nodelet)
