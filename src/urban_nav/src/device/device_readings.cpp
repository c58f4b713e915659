// SPDX-License-Identifier: BSD-3-Clause
#include "device/device_readings.hpp"

#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/NavSatFix.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::DataError;
using urban_nav_core::UserError;

namespace {

constexpr double earth_field = 50e-6;  // T, about 1 unit of an MTi

/// Calls `take(message, time)` for each message of a topic; `time`: s since the bag begins, the same for all devices.
/// Returns the begin, s.
template <typename Message>
double forEachOfTopic(const std::string& path, const std::string& topic,
                      const std::function<void(const Message& message, double time)>& take) {
  try {
    rosbag::Bag bag(path, rosbag::bagmode::Read);
    rosbag::View view(
        bag, [&](const rosbag::ConnectionInfo* each) { return each->topic == topic || each->topic == "/" + topic; });
    const double begin = rosbag::View(bag).getBeginTime().toSec();
    bool is_empty = true;
    for (const rosbag::MessageInstance& instance : view) {
      const auto message = instance.instantiate<Message>();
      if (!message) continue;
      is_empty = false;
      take(*message, std::max(message->header.stamp.toSec() - begin, 0.0));
    }
    if (is_empty) throw DataError(path, "holds nothing on " + topic, "");
    return begin;
  } catch (const rosbag::BagException& error) {
    throw UserError(path, error.what(), "a bag of urban_nav simulate");
  }
}

std::vector<urban_nav_sim::LaserReading> readLaserReadings(const std::string& bag, const std::string& side) {
  std::vector<urban_nav_sim::LaserReading> readings;
  forEachOfTopic<sensor_msgs::LaserScan>(bag, "laser_" + side + "/scan",
                                         [&](const sensor_msgs::LaserScan& scan, double time) {
                                           readings.push_back({time, scan.ranges, scan.intensities});
                                         });
  return readings;
}

std::vector<urban_nav_sim::ImuReading> readImuReadings(const std::string& bag) {
  std::vector<urban_nav_sim::ImuReading> readings;
  forEachOfTopic<sensor_msgs::Imu>(bag, "imu/data", [&](const sensor_msgs::Imu& imu, double time) {
    urban_nav_sim::ImuReading reading;
    reading.time = time;
    reading.acceleration = {imu.linear_acceleration.x, imu.linear_acceleration.y, imu.linear_acceleration.z};
    reading.rate = {imu.angular_velocity.x, imu.angular_velocity.y, imu.angular_velocity.z};
    const auto& q = imu.orientation;
    if (imu.orientation_covariance[0] >= 0.0 && std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < 0.01)
      reading.orientation = {q.w, q.x, q.y, q.z};
    readings.push_back(reading);
  });
  std::size_t i = 0;
  forEachOfTopic<sensor_msgs::MagneticField>(bag, "imu/mag", [&](const sensor_msgs::MagneticField& field, double) {
    if (i == readings.size()) return;
    readings[i++].field = {field.magnetic_field.x / earth_field, field.magnetic_field.y / earth_field,
                           field.magnetic_field.z / earth_field};
  });
  return readings;
}

std::vector<urban_nav_sim::WheelReading> readWheelReadings(const std::string& bag) {
  std::vector<urban_nav_sim::WheelReading> readings;
  forEachOfTopic<nav_msgs::Odometry>(bag, "wheel_odom", [&](const nav_msgs::Odometry& odometry, double time) {
    readings.push_back({time, odometry.twist.twist.linear.x, odometry.twist.twist.angular.z});
  });
  return readings;
}

std::vector<urban_nav_sim::GpsReading> readGpsReadings(const std::string& bag, double& begin) {
  std::vector<urban_nav_sim::GpsReading> readings;
  begin = forEachOfTopic<sensor_msgs::NavSatFix>(bag, "gps/fix", [&](const sensor_msgs::NavSatFix& fix, double time) {
    urban_nav_sim::GpsReading reading;
    reading.time = time;
    reading.valid = fix.status.status >= 0 && std::isfinite(fix.latitude) && std::isfinite(fix.longitude);
    if (reading.valid) {
      reading.latitude = fix.latitude;
      reading.longitude = fix.longitude;
      reading.height = std::isfinite(fix.altitude) ? fix.altitude : 0.0;
      if (fix.position_covariance[0] > 0.0) reading.sigma = std::min(std::sqrt(fix.position_covariance[0]), 100.0);
    }
    readings.push_back(reading);
  });
  std::size_t i = 0;
  forEachOfTopic<geometry_msgs::TwistStamped>(bag, "gps/vel", [&](const geometry_msgs::TwistStamped& velocity, double) {
    if (i == readings.size()) return;
    const double east = velocity.twist.linear.x, north = velocity.twist.linear.y;
    urban_nav_sim::GpsReading& reading = readings[i++];
    if (!std::isfinite(east) || !std::isfinite(north)) return;
    reading.speed = std::hypot(east, north);
    reading.track = std::fmod(std::atan2(east, north) * 180.0 / 3.14159265358979323846 + 360.0, 360.0);
  });
  return readings;
}

}  // namespace

DeviceReadings readReadings(const std::string& bag, const std::string& kind, const std::string& side) {
  DeviceReadings readings;
  if (kind == "lms291") readings.lasers = readLaserReadings(bag, side);
  else if (kind == "xsens_mti") readings.imu = readImuReadings(bag);
  else if (kind == "segway_rmp") readings.wheels = readWheelReadings(bag);
  else if (kind == "gps") readings.gps = readGpsReadings(bag, readings.gps_begin);
  else throw UserError("KIND", kind, "lms291, xsens_mti, segway_rmp, gps");
  return readings;
}

}  // namespace urban_nav
