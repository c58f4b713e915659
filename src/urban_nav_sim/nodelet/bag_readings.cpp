// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/ros/bag_readings.hpp"

#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/NavSatFix.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_sim {

using urban_nav_core::DataError;
using urban_nav_core::UserError;

namespace {

constexpr double kEarthField = 50e-6;  // T, about 1 unit of an MTi
constexpr double kSameTime = 1e-4;     // s

enum class BagTopic { Required, Optional };

/// Calls `take(message, time)` for each message of a topic; `time`: s since the begin of the bag, common to all
/// devices. Returns the begin, s.
template <typename Message>
double forEachOfTopic(const std::string& path, const std::string& topic, BagTopic kind,
                      const std::function<void(const Message& message, double time)>& take) {
  urban_nav_input::Recording recording(path);
  const double begin = urban_nav_ros::toRosTime(recording.begin()).toSec();
  urban_nav_input::RecordedMessages messages = recording.messages({topic, "/" + topic});
  bool is_empty = true;
  while (const auto each = messages.next()) {
    const auto message = each->template as<Message>();
    if (!message) continue;
    is_empty = false;
    take(*message, std::max(message->header.stamp.toSec() - begin, 0.0));
  }
  if (is_empty && kind == BagTopic::Required) throw DataError(path, "has no messages on " + topic, "");
  return begin;
}

/// Returns the reading at a time; null without one. `at` must ascend from call to call.
template <typename Reading>
Reading* findReading(std::vector<Reading>& readings, std::size_t& at, double time) {
  while (at < readings.size() && readings[at].time < time - kSameTime) ++at;
  return at < readings.size() && readings[at].time < time + kSameTime ? &readings[at] : nullptr;
}

std::vector<LaserReading> readLaserReadings(const std::string& bag, const std::string& side) {
  std::vector<LaserReading> readings;
  forEachOfTopic<sensor_msgs::LaserScan>(
      bag, side == "left" ? urban_nav_ros::topics::kLaserLeft : urban_nav_ros::topics::kLaserRight, BagTopic::Required,
      [&](const sensor_msgs::LaserScan& scan, double time) {
        readings.push_back({time, scan.ranges, scan.intensities});
      });
  return readings;
}

std::vector<ImuReading> readImuReadings(const std::string& bag) {
  std::vector<ImuReading> readings;
  forEachOfTopic<sensor_msgs::Imu>(
      bag, urban_nav_ros::topics::kImu, BagTopic::Required, [&](const sensor_msgs::Imu& imu, double time) {
        ImuReading reading;
        reading.time = time;
        reading.acceleration = {imu.linear_acceleration.x, imu.linear_acceleration.y, imu.linear_acceleration.z};
        reading.rate = {imu.angular_velocity.x, imu.angular_velocity.y, imu.angular_velocity.z};
        const auto& q = imu.orientation;
        if (imu.orientation_covariance[0] >= 0.0 &&
            std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < 0.01)
          reading.orientation = {q.w, q.x, q.y, q.z};
        readings.push_back(reading);
      });
  std::size_t at = 0;
  forEachOfTopic<sensor_msgs::MagneticField>(bag, urban_nav_ros::topics::kMagneticField, BagTopic::Optional,
                                             [&](const sensor_msgs::MagneticField& field, double time) {
                                               if (ImuReading* reading = findReading(readings, at, time))
                                                 reading->field = {field.magnetic_field.x / kEarthField,
                                                                   field.magnetic_field.y / kEarthField,
                                                                   field.magnetic_field.z / kEarthField};
                                             });
  return readings;
}

std::vector<WheelReading> readWheelReadings(const std::string& bag) {
  std::vector<WheelReading> readings;
  forEachOfTopic<nav_msgs::Odometry>(
      bag, urban_nav_ros::topics::kWheelOdometry, BagTopic::Required,
      [&](const nav_msgs::Odometry& odometry, double time) {
        readings.push_back({time, odometry.twist.twist.linear.x, odometry.twist.twist.angular.z});
      });
  return readings;
}

std::vector<GpsReading> readGpsReadings(const std::string& bag, double& begin) {
  std::vector<GpsReading> readings;
  begin = forEachOfTopic<sensor_msgs::NavSatFix>(
      bag, urban_nav_ros::topics::kGpsFix, BagTopic::Required, [&](const sensor_msgs::NavSatFix& fix, double time) {
        GpsReading reading;
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
  std::size_t at = 0;
  forEachOfTopic<geometry_msgs::TwistStamped>(
      bag, urban_nav_ros::topics::kGpsVelocity, BagTopic::Optional,
      [&](const geometry_msgs::TwistStamped& velocity, double time) {
        const double east = velocity.twist.linear.x, north = velocity.twist.linear.y;
        GpsReading* reading = findReading(readings, at, time);
        if (reading == nullptr || !std::isfinite(east) || !std::isfinite(north)) return;
        reading->speed = std::hypot(east, north);
        reading->track = std::fmod(std::atan2(east, north) * 180.0 / 3.14159265358979323846 + 360.0, 360.0);
      });
  return readings;
}

}  // namespace

DeviceReadings readBagReadings(const std::string& bag, const std::string& kind, const std::string& side) {
  DeviceReadings readings;
  if (kind == "lms291") readings.lasers = readLaserReadings(bag, side);
  else if (kind == "xsens_mti") readings.imu = readImuReadings(bag);
  else if (kind == "segway_rmp") readings.wheels = readWheelReadings(bag);
  else if (kind == "gps") readings.gps = readGpsReadings(bag, readings.gps_begin);
  else throw UserError("KIND", kind, "lms291, xsens_mti, segway_rmp, gps");
  return readings;
}

}  // namespace urban_nav_sim
