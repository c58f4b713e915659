// SPDX-License-Identifier: BSD-3-Clause
#include <geometry_msgs/TwistStamped.h>
#include <sensor_msgs/NavSatFix.h>
#include <pluginlib/class_list_macros.hpp>

#include <cmath>
#include <limits>

#include "driver_nodelet.hpp"
#include "segway_drivers/driver/driver_options.hpp"
#include "urban_nav_ros/topics.hpp"

namespace segway_drivers {

namespace {

constexpr double kGpsRadian = 3.14159265358979323846 / 180.0;
constexpr double kLeastSpeed = 0.5;  // m/s, below which the course is noise

sensor_msgs::NavSatFix toNavSatFix(const GpsFix& fix) {
  sensor_msgs::NavSatFix message;
  using Status = sensor_msgs::NavSatStatus;
  message.status.service = Status::SERVICE_GPS;
  message.status.status = fix.mode == GpsFix::Mode::None         ? Status::STATUS_NO_FIX
                          : fix.carrier != GpsFix::Carrier::None ? Status::STATUS_GBAS_FIX
                          : fix.differential                     ? Status::STATUS_SBAS_FIX
                                                                 : Status::STATUS_FIX;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  message.latitude = fix.latitude.value_or(unknown);
  message.longitude = fix.longitude.value_or(unknown);
  message.altitude = fix.height.value_or(unknown);
  if (!fix.sigma_e || !fix.sigma_n) return message;
  message.position_covariance[0] = *fix.sigma_e * *fix.sigma_e;
  message.position_covariance[4] = *fix.sigma_n * *fix.sigma_n;
  message.position_covariance[8] = fix.sigma_u ? *fix.sigma_u * *fix.sigma_u : 1e6;
  message.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_APPROXIMATED;
  return message;
}

}  // namespace

/// Receiver: publishes `gps/fix` for each cycle, also without a fix, and `gps/vel` in ENU.
class GpsNodelet : public DriverNodelet {
 public:
  ~GpsNodelet() override { shutDown(); }

 private:
  std::string device() const override { return "gps"; }

  std::unique_ptr<DriverCore> makeDriver(const Parameters& parameters) override {
    frame_ = frameOr("gps_link");
    fix_ = getNodeHandle().advertise<sensor_msgs::NavSatFix>(urban_nav_ros::topics::kGpsFix, 10);
    velocity_ = getNodeHandle().advertise<geometry_msgs::TwistStamped>(urban_nav_ros::topics::kGpsVelocity, 10);
    auto driver = std::make_unique<GpsDriver>(toGpsOptions(parameters, nodelet().port));
    driver->on_fix = [this](const GpsFix& fix, std::optional<TimeNs> stamp) { take(fix, stamp); };
    return driver;
  }

  void take(const GpsFix& fix, std::optional<TimeNs> stamp) {
    if (!stamp) return;
    sensor_msgs::NavSatFix message = toNavSatFix(fix);
    message.header.stamp = toRos(*stamp);
    message.header.frame_id = frame_;
    publish([this, message] { fix_.publish(message); });
    if (fix.mode == GpsFix::Mode::None || !fix.speed || !fix.track || *fix.speed < kLeastSpeed) return;
    geometry_msgs::TwistStamped velocity;
    velocity.header = message.header;
    velocity.twist.linear.x = *fix.speed * std::sin(kGpsRadian * *fix.track);
    velocity.twist.linear.y = *fix.speed * std::cos(kGpsRadian * *fix.track);
    velocity.twist.linear.z = fix.climb.value_or(0.0);
    publish([this, velocity] { velocity_.publish(velocity); });
  }

  std::string frame_;
  ros::Publisher fix_, velocity_;
};

}  // namespace segway_drivers

PLUGINLIB_EXPORT_CLASS(segway_drivers::GpsNodelet, nodelet::Nodelet)
