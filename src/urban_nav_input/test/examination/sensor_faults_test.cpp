// SPDX-License-Identifier: BSD-3-Clause
// Faults of lasers, IMU, wheels, GPS, tf and clocks, injected one at a time into a sound session: each is named with
// its cause, and nothing in the sound one.
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <regex>

#include "urban_nav_input/examination/diagnosis.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::Vector3d;

constexpr double kFaultStart = 1.5e9, kSeconds = 24.0, kRadius = 8.0, kTurnRate = 0.15;  // s; m and rad/s: a circle
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr float kNoNumberF = std::numeric_limits<float>::quiet_NaN();

/// Changes to the messages of each topic before they are written; `t`: s after the start.
struct Injection {
  std::function<void(sensor_msgs::LaserScan&, double t)> left_scan = {};
  std::function<void(sensor_msgs::Imu&, double t)> imu = {};
  std::function<void(nav_msgs::Odometry&, double t)> wheels = {};
  std::function<void(sensor_msgs::NavSatFix&, double t)> fix = {};
  std::function<void(geometry_msgs::TransformStamped&)> transform = {};  ///< an empty child: left out
  std::function<std::string(const std::string&)> topic = {};
  std::function<void(rosbag::Bag&)> more = {};
};

template <typename Message, typename Change>
void write(rosbag::Bag& bag, const Injection& injection, const std::string& topic, double t, Message message,
           const Change& change) {
  message.header.stamp = ros::Time(kFaultStart + t);
  if (change) change(message, t);
  bag.write(injection.topic ? injection.topic(topic) : topic, ros::Time(kFaultStart + t + 0.01), message);
}

void writeTransforms(rosbag::Bag& bag, const Injection& injection) {
  tf2_msgs::TFMessage message;
  const Pose optical = urban_nav_ros::opticalInBody();
  for (geometry_msgs::TransformStamped transform :
       {urban_nav_ros::toStaticTransform("base_link", "camera", Pose(optical.q(), Vector3d(0.3, 0.1, 0.9))),
        urban_nav_ros::toStaticTransform("base_link", "imu_link", Pose(Quaterniond::Identity(), Vector3d(0, 0, 0.2))),
        urban_nav_ros::toStaticTransform("base_link", "gps_link", Pose(Quaterniond::Identity(), Vector3d(0, 0, 1.2))),
        urban_nav_ros::toStaticTransform("base_link", "laser_left",
                                         Pose(Quaterniond::Identity(), Vector3d(0, 0.2, 0.6))),
        urban_nav_ros::toStaticTransform("base_link", "laser_right",
                                         Pose(Quaterniond::Identity(), Vector3d(0, -0.2, 0.6)))}) {
    if (injection.transform) injection.transform(transform);
    if (!transform.child_frame_id.empty()) message.transforms.push_back(transform);
  }
  bag.write("/tf_static", ros::Time(kFaultStart), message);
}

void writeImages(rosbag::Bag& bag, const Injection& injection) {
  sensor_msgs::Image image;
  image.header.frame_id = "camera";
  image.encoding = "mono8";
  image.width = image.step = 32;
  image.height = 24;
  image.data.assign(image.step * image.height, 100);
  sensor_msgs::CameraInfo info;
  info.header.frame_id = "camera";
  info.width = 32;
  info.height = 24;
  const std::function<void(sensor_msgs::Image&, double)> none;
  for (int i = 0; i < 5 * kSeconds; ++i)
    for (const bool is_right : {false, true}) {
      const std::string side = is_right ? "/stereo/right/" : "/stereo/left/";
      image.data[static_cast<std::size_t>(i) % image.data.size()] = static_cast<std::uint8_t>(i);
      info.P = {30, 0, 15.5, is_right ? -6.0 : 0.0, 0, 30, 11.5, 0, 0, 0, 1, 0};
      write(bag, injection, side + "image_raw", 0.2 * i, image, none);
      write(bag, injection, side + "camera_info", 0.2 * i, info,
            std::function<void(sensor_msgs::CameraInfo&, double)>());
    }
}

void writeScans(rosbag::Bag& bag, const Injection& injection, std::mt19937& random) {
  sensor_msgs::LaserScan scan;
  scan.angle_min = -1.5F;
  scan.angle_increment = 0.05F;
  scan.angle_max = 1.5F;
  scan.scan_time = 0.1F;
  scan.time_increment = 0.0005F;
  scan.range_min = 0.1F;
  scan.range_max = 80.0F;
  scan.ranges.resize(61);
  for (int i = 0; i < 10 * kSeconds; ++i)
    for (const bool is_right : {false, true}) {
      scan.header.frame_id = is_right ? "laser_right" : "laser_left";
      for (std::size_t k = 0; k < scan.ranges.size(); ++k)  // a room of 4 to 8 m
        scan.ranges[k] =
            6.0F + 2.0F * std::sin(0.1F * static_cast<float>(k)) + 1e-9F * static_cast<float>(random() % 20'000'000U);
      write(bag, injection, "/" + scan.header.frame_id + "/scan", 0.1 * i, scan,
            is_right ? std::function<void(sensor_msgs::LaserScan&, double)>() : injection.left_scan);
    }
}

void writeMotion(rosbag::Bag& bag, const Injection& injection, std::mt19937& random) {
  const auto noise = [&random] { return 1e-11 * static_cast<double>(random()) - 0.02; };
  for (int i = 0; i < 50 * kSeconds; ++i) {
    const double t = 0.02 * i, turn = kTurnRate * std::sin(0.5 * t),
                 heading = 2.0 * kTurnRate * (1.0 - std::cos(0.5 * t));
    sensor_msgs::Imu imu;
    imu.header.frame_id = "imu_link";
    imu.angular_velocity.z = turn + noise();
    imu.linear_acceleration.x = noise();
    imu.linear_acceleration.y = turn * kRadius * kTurnRate + noise();
    imu.linear_acceleration.z = 9.81 + noise();
    write(bag, injection, "/imu/data", t, imu, injection.imu);
    if (i % 2 == 1) continue;
    nav_msgs::Odometry wheels;
    wheels.pose.pose.position.x = kRadius * kTurnRate * t;
    wheels.pose.pose.orientation.z = std::sin(0.5 * heading);
    wheels.pose.pose.orientation.w = std::cos(0.5 * heading);
    wheels.twist.twist.linear.x = kRadius * kTurnRate;
    wheels.twist.twist.angular.z = turn;
    write(bag, injection, "/wheel_odom", t, wheels, injection.wheels);
  }
  for (int i = 0; i < 2 * kSeconds; ++i) {
    sensor_msgs::NavSatFix fix;
    fix.header.frame_id = "gps_link";
    fix.latitude = 51.75 + 5e-6 * i;
    fix.longitude = -1.25;
    fix.altitude = 112.0;
    fix.position_covariance[0] = fix.position_covariance[4] = fix.position_covariance[8] = 4.0;
    fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
    write(bag, injection, "/gps/fix", 0.5 * i, fix, injection.fix);
  }
}

std::vector<Finding> examineWith(const Injection& injection) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.file("a.bag");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    std::mt19937 random(3);
    writeTransforms(bag, injection);
    writeImages(bag, injection);
    writeScans(bag, injection, random);
    writeMotion(bag, injection, random);
    if (injection.more) injection.more(bag);
  }
  std::vector<Finding> findings;
  for (const InputSession& session : findSessions({path}))
    for (Finding& finding : examine(session, {}, [](std::int64_t, std::int64_t) {}).findings)
      findings.push_back(std::move(finding));
  return findings;
}

/// A fault, and what a finding has to state of it.
struct Fault {
  std::string name;
  Injection injection;
  std::string kind, words, option = {};  ///< words and option: regular expressions
};

Injection onScans(std::function<void(sensor_msgs::LaserScan&, double)> change) {
  Injection injection;
  injection.left_scan = std::move(change);
  return injection;
}
Injection onImu(std::function<void(sensor_msgs::Imu&, double)> change) {
  Injection injection;
  injection.imu = std::move(change);
  return injection;
}
Injection onForce(const std::function<Vector3d(const Vector3d&)>& change) {
  return onImu([change](sensor_msgs::Imu& imu, double) {
    auto& force = imu.linear_acceleration;
    const Vector3d changed = change({force.x, force.y, force.z});
    force.x = changed.x(), force.y = changed.y(), force.z = changed.z();
  });
}
Injection onWheels(std::function<void(nav_msgs::Odometry&, double)> change) {
  Injection injection;
  injection.wheels = std::move(change);
  return injection;
}
Injection onFixes(std::function<void(sensor_msgs::NavSatFix&, double)> change) {
  Injection injection;
  injection.fix = std::move(change);
  return injection;
}
Injection onTransform(const std::string& child, const std::function<void(geometry_msgs::TransformStamped&)>& change) {
  Injection injection;
  injection.transform = [=](geometry_msgs::TransformStamped& transform) {
    if (transform.child_frame_id == child) change(transform);
  };
  return injection;
}
Injection onTopics(std::function<std::string(const std::string&)> change) {
  Injection injection;
  injection.topic = std::move(change);
  return injection;
}
template <typename Message>
std::function<void(Message&, double)> shiftStamp(double seconds) {
  return [seconds](Message& message, double) { message.header.stamp += ros::Duration(seconds); };
}
std::function<std::string(const std::string&)> rename(const std::string& from, const std::string& to) {
  return [=](const std::string& topic) { return topic == from ? to : topic; };
}

std::vector<Fault> laserFaults() {
  using Scan = sensor_msgs::LaserScan;
  const auto all = [](float value) {
    return [value](Scan& scan, double) { std::fill(scan.ranges.begin(), scan.ranges.end(), value); };
  };
  const auto scaled = [](float factor) {
    return [factor](Scan& scan, double) {
      for (float& range : scan.ranges) range *= factor;
      scan.range_min *= factor, scan.range_max *= factor;
    };
  };
  return {
      {"angles in degrees", onScans([](Scan& scan, double) {
         scan.angle_min *= 57.29578F, scan.angle_max *= 57.29578F, scan.angle_increment *= 57.29578F;
       }),
       "lasers", "in degrees", "laser_left_angle_scale=0\\.01745"},
      {"millimetres", onScans(scaled(1000.0F)), "lasers", "millimetres", "laser_left_range_scale=0\\.001"},
      {"centimetres", onScans(scaled(100.0F)), "lasers", "centimetres", "laser_left_range_scale=0\\.01"},
      {"an increment in degrees", onScans([](Scan& scan, double) { scan.angle_increment *= 57.29578F; }), "lasers",
       "in degrees", "laser_left_angle_scale=0\\.01745"},
      {"ends in degrees", onScans([](Scan& scan, double) { scan.angle_min *= 57.29578F, scan.angle_max *= 57.29578F; }),
       "lasers", "in degrees", "laser_left_angle_scale=0\\.01745"},
      {"millimetres within limits in metres", onScans([](Scan& scan, double) {
         for (float& range : scan.ranges) range *= 1000.0F;
       }),
       "lasers", "millimetres", "laser_left_range_scale=0\\.001"},
      {"no increment", onScans([](Scan& scan, double) { scan.angle_increment = 0.0F; }), "lasers", "angle_increment"},
      {"times in milliseconds", onScans([](Scan& scan, double) { scan.time_increment = 0.5F; }), "lasers",
       "milliseconds", "laser_left_time_scale=0\\.001"},
      {"times not finite", onScans([](Scan& scan, double) { scan.time_increment = kNoNumberF; }), "lasers",
       "time_increment"},
      {"range_max of zero", onScans([](Scan& scan, double) { scan.range_min = scan.range_max = 0.0F; }), "lasers",
       "range_max"},
      {"range_max not finite", onScans([](Scan& scan, double) { scan.range_max = kNoNumberF; }), "lasers", "range_max"},
      {"scan_time not finite", onScans([](Scan& scan, double) { scan.scan_time = kNoNumberF; }), "lasers", "scan_time"},
      {"angles not finite", onScans([](Scan& scan, double) { scan.angle_min = kNoNumberF; }), "lasers", "not finite"},
      {"ranges not finite", onScans(all(kNoNumberF)), "lasers", "0 % of the beams"},
      {"ranges of zero", onScans(all(0.0F)), "lasers", "0 % of the beams"},
      {"frozen ranges", onScans(all(6.5F)), "lasers", "frozen"},
      {"wrong increment", onScans([](Scan& scan, double) { scan.angle_increment = 0.01F; }), "lasers",
       "angle_increment"},
      {"no stamps", onScans([](Scan& scan, double) { scan.header.stamp = ros::Time(); }), "stamps", "no stamp"},
      {"a clock that is late", onScans(shiftStamp<Scan>(-3.0)), "stamps", "3 s earlier", "laser_left_delay=-3000"},
      {"a clock that began in 1970", onScans(shiftStamp<Scan>(-kFaultStart + 100.0)), "stamps", "earlier",
       "laser_left_delay=-1"},
      {"a clock that drifts", onScans([](Scan& scan, double t) { scan.header.stamp += ros::Duration(0.015 * t); }),
       "stamps", "drifts"},
      {"a gap", onTopics([n = 0](const std::string& topic) mutable {
         return topic == "/laser_left/scan" && ++n > 60 && n < 120 ? "/elsewhere" : topic;
       }),
       "rates", "laser_left/scan has a gap"}};
}

std::vector<Fault> imuFaults() {
  using Imu = sensor_msgs::Imu;
  return {{"the sign of NED", onForce([](const Vector3d& a) { return Vector3d(-a); }), "imu", "NED",
           "accelerometer_axes=-x,-y,-z"},
          {"axes exchanged", onForce([](const Vector3d& a) { return Vector3d(a.z(), a.x(), a.y()); }), "imu",
           "exchanged", "accelerometer_axes=y,z,x"},
          {"force in g", onForce([](const Vector3d& a) { return Vector3d(a / 9.80665); }), "imu", "its unit is g",
           "accelerometer_scale=9\\.80665"},
          {"force in thousandths of g", onForce([](const Vector3d& a) { return Vector3d(1000.0 * a / 9.80665); }),
           "imu", "thousandths of g", "accelerometer_scale=0\\.0098"},
          {"no gravity", onForce([](const Vector3d& a) { return Vector3d(a.x(), a.y(), a.z() - 9.81); }), "imu",
           "subtracts gravity"},
          {"wrong scale", onForce([](const Vector3d& a) { return Vector3d(0.7 * a); }), "imu", "wrong scale"},
          {"not finite for a while", onImu([](Imu& imu, double t) {
             if (t > 5.99 && t < 17.99) imu.linear_acceleration.x = kNoNumber;
           }),
           "imu", "50 % of"},
          {"frozen", onImu([](Imu& imu, double) {
             imu.angular_velocity.z = 0.1, imu.linear_acceleration = {}, imu.linear_acceleration.z = 9.81;
           }),
           "imu", "frozen"},
          {"rates in deg/s", onImu([](Imu& imu, double) { imu.angular_velocity.z *= 180.0 / M_PI; }), "imu", "deg/s",
           "gyroscope_scale=0\\.01745"},
          {"rates of the sign of NED", onImu([](Imu& imu, double) { imu.angular_velocity.z *= -1.0; }), "imu",
           "wrong sign"},
          {"no stamps", onImu([](Imu& imu, double) { imu.header.stamp = ros::Time(); }), "stamps", "no stamp"},
          {"a clock that is ahead", onImu(shiftStamp<Imu>(2.0)), "stamps", "2 s later", "imu_delay=2000"},
          {"no place in tf", onTransform("imu_link", [](auto& transform) { transform.child_frame_id.clear(); }), "tf",
           "imu"},
          {"another name", onTopics(rename("/imu/data", "/mti/sensor")), "topics", "/mti/sensor", "imu:=/mti/sensor"}};
}

std::vector<Fault> otherFaults() {
  using Fix = sensor_msgs::NavSatFix;
  using Odometry = nav_msgs::Odometry;
  return {
      {"altitude not finite", onFixes([](Fix& fix, double) { fix.altitude = kNoNumber; }), "gps", "altitude"},
      {"latitude not finite", onFixes([](Fix& fix, double) { fix.latitude = kNoNumber; }), "gps", "latitude"},
      {"position of zero", onFixes([](Fix& fix, double) { fix.latitude = fix.longitude = 0.0; }), "gps", "latitude 0"},
      {"no fix", onFixes([](Fix& fix, double) { fix.status.status = -1; }), "gps", "status below 0"},
      {"frozen fixes", onFixes([](Fix& fix, double) { fix.latitude = 51.75; }), "gps", "frozen"},
      {"fixes that jump", onFixes([](Fix& fix, double t) { fix.latitude += std::fmod(t, 3.0) < 0.4 ? 0.02 : 0.0; }),
       "gps", "jumps"},
      {"covariance of zero", onFixes([](Fix& fix, double) { fix.position_covariance.fill(0.0); }), "gps",
       "covariance of zero"},
      {"fixes without stamps", onFixes([](Fix& fix, double) { fix.header.stamp = ros::Time(); }), "gps", "no stamp"},
      {"seconds of UTC", onFixes(shiftStamp<Fix>(18.0)), "stamps", "18 s later", "gps_delay=18000"},
      {"wheels not finite", onWheels([](Odometry& wheels, double) { wheels.pose.pose.position.x = kNoNumber; }),
       "wheels", "not finite"},
      {"wheels without pose",
       onWheels([](Odometry& wheels, double) { wheels.pose.pose = {}, wheels.pose.pose.orientation.w = 1.0; }),
       "wheels", "pose does not move"},
      {"a clock of the wheels", onWheels(shiftStamp<Odometry>(-5.0)), "stamps", "5 s earlier", "wheels_delay=-5000"},
      {"no place of a laser", onTransform("laser_left", [](auto& transform) { transform.child_frame_id.clear(); }),
       "tf", "no static tf.*laser_left"},
      {"a quaternion too long", onTransform("laser_left", [](auto& t) { t.transform.rotation.w = 1.03; }), "tf",
       "quaternion of length 1\\.03"},
      {"a quaternion of zeros", onTransform("laser_left", [](auto& t) { t.transform.rotation.w = 0.0; }), "tf",
       "no rigid motion"},
      {"two places of a laser",
       {{},
        {},
        {},
        {},
        {},
        {},
        [](rosbag::Bag& bag) {
          tf2_msgs::TFMessage message;
          message.transforms.push_back(urban_nav_ros::toStaticTransform(
              "base_link", "laser_left", Pose(Quaterniond::Identity(), Vector3d(0, 0.2, 0.9))));
          bag.write("/tf_static", ros::Time(kFaultStart + 1.0), message);
        }},
       "tf",
       "contradict each other"},
      {"a place in millimetres",
       onTransform("laser_left", [](auto& t) { t.transform.translation.y = 200.0, t.transform.translation.z = 600.0; }),
       "tf", "millimetres", "base_link,laser_left:0,0\\.2,0\\.6,"}};
}

std::string print(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += std::string(toString(finding.kind)) + ": " + finding.text;
    for (const std::string& option : finding.options) text += " | " + option;
    text += "\n";
  }
  return text;
}

TEST(SensorFaults, NothingIsFoundInASoundSession) { EXPECT_EQ(print(examineWith({})), ""); }

void expectNamed(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    const std::vector<Finding> findings = examineWith(fault.injection);
    const bool is_named = std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
      std::string options;
      for (const std::string& option : finding.options) options += option + " ";
      return toString(finding.kind) == fault.kind && std::regex_search(finding.text, std::regex(fault.words)) &&
             std::regex_search(options, std::regex(fault.option)) && !finding.remedy.empty();
    });
    EXPECT_TRUE(is_named) << fault.name << ":\n" << print(findings);
    EXPECT_LE(findings.size(), 3U) << fault.name << ":\n" << print(findings);
  }
}

TEST(SensorFaults, OfLasersAreNamedWithTheirCause) { expectNamed(laserFaults()); }
TEST(SensorFaults, OfTheImuAreNamedWithTheirCause) { expectNamed(imuFaults()); }
TEST(SensorFaults, OfGpsWheelsAndTfAreNamedWithTheirCause) { expectNamed(otherFaults()); }

}  // namespace
}  // namespace urban_nav_input
