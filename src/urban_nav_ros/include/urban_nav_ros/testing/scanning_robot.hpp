// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/testing/scanner.hpp"
#include "urban_nav_ros/testing/driving_robot.hpp"

namespace urban_nav_ros::testing {

constexpr double kPeriod = 0.1, kSpeed = 1.0;              // s, m/s
constexpr double kHalfWay = 12.0, kAside = 1.0;            // m
constexpr double kTurn = 3.14159265358979323846 * kAside;  // m
constexpr int kFrames = static_cast<int>((4.0 * kHalfWay + kTurn) / (kSpeed * kPeriod));
constexpr int kDriftFrame = static_cast<int>((2.0 * kHalfWay + 0.5 * kTurn) / (kSpeed * kPeriod));  // in the turn
constexpr double kDriftSigma = 0.1;                                                                 // m, rad

/// Robot of the class Robot without a camera, in a courtyard: it drives along it, turns around and returns two metres
/// beside. Its lasers face ahead to the left and back to the right, so that both passes scan the same fronts. Odometry
/// has an error in one step of the turn, with a matching covariance.
template <typename Robot>
class ScanningRobot : public Robot {
 public:
  ScanningRobot() {
    tf2_msgs::TFMessage message;
    for (const auto& [frame, T_base_laser] : lasers())
      message.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", frame, T_base_laser));
    scanning_ = this->until([this] { return this->isConnected(); });
    tf_static_.publish(message);
  }
  bool scanning() const { return scanning_; }

  static StampNs toStamp(int frame) {
    return kStart + 100 * kEpoch + static_cast<StampNs>(std::llround(1e9 * kPeriod * frame));
  }
  static Pose T_world_base(int frame) {
    const double way = kSpeed * kPeriod * frame, straight = 2.0 * kHalfWay;
    if (way < straight) return at(way - kHalfWay, -kAside, 0.0);
    const double angle = std::min((way - straight) / kAside, 3.14159265358979323846);
    if (way < straight + kTurn) return at(kHalfWay + kAside * std::sin(angle), -kAside * std::cos(angle), angle);
    return at(kHalfWay - (way - straight - kTurn), kAside, angle);
  }
  /// Return the frame at `x` on the outward and on the return path.
  static int there(double x) { return static_cast<int>(std::lround((kHalfWay + x) / (kSpeed * kPeriod))); }
  static int back(double x) { return static_cast<int>(std::lround((3.0 * kHalfWay + kTurn - x) / (kSpeed * kPeriod))); }

  static Pose drift() {
    urban_nav_core::Vector6d d;
    d << 0.12, -0.08, 0.02, 0.01, -0.01, 0.06;
    return urban_nav_core::expSe3(d);
  }
  static Pose stepTo(int frame) {
    const Pose T = T_world_base(frame - 1).inverse() * T_world_base(frame);
    return frame == kDriftFrame ? T * drift() : T;
  }
  /// Publishes frames from ... to - 1, and the steps between them.
  void drive(int from, int to) {
    for (int i = from; i < to; ++i) {
      if (i > first_) T_odom_base_ = T_odom_base_ * stepTo(i);
      else first_ = i;
      this->beAt(toStamp(i), T_odom_base_);
      if (i > first_) this->step(toStamp(i - 1), toStamp(i), stepTo(i), i == kDriftFrame ? kDriftSigma : 5e-4);
    }
  }
  void scan(int from, int to) {
    for (int i = from; i < to; ++i)
      for (const auto& [frame, T_base_laser] : lasers())
        (frame == "laser_left" ? left_ : right_).publish(scanAt(i, frame, T_base_laser));
  }

  /// x in the viewing direction, y up: the scan plane is upright.
  static std::vector<std::pair<std::string, Pose>> lasers() {
    std::vector<std::pair<std::string, Pose>> made;
    for (const auto& [frame, heading] :
         {std::pair("laser_left", 0.6), std::pair("laser_right", 0.7 - 3.14159265358979323846)}) {
      Eigen::Matrix3d R;
      R.col(0) << std::cos(heading), std::sin(heading), 0.0;
      R.col(1) = Eigen::Vector3d::UnitZ();
      R.col(2) = R.col(0).cross(R.col(1));
      made.emplace_back(frame, Pose(R, {0.0, heading > 0.0 ? 0.3 : -0.3, 1.0}));
    }
    return made;
  }
  static sensor_msgs::LaserScan scanAt(int i, const std::string& frame, const Pose& T_base_laser) {
    urban_nav_core::testing::Scanner planar;
    planar.rings = 1;
    planar.beams = 360;
    planar.lowest = 0.0;
    planar.sigma = 0.01;
    const std::uint64_t seed = 2 * static_cast<std::uint64_t>(i) + (frame == "laser_left" ? 0 : 1);
    sensor_msgs::LaserScan message;
    message.header.stamp = urban_nav_ros::toRosTime(toStamp(i));
    message.header.frame_id = frame;
    message.angle_min = static_cast<float>(-0.5 * 3.14159265358979323846);
    message.angle_max = -message.angle_min;
    message.angle_increment = static_cast<float>(3.14159265358979323846 / 180.0);
    message.range_min = 0.1F;
    message.range_max = 60.0F;
    message.ranges.assign(181, std::numeric_limits<float>::infinity());
    for (const Eigen::Vector3f& p :
         urban_nav_core::testing::scan(world(), T_world_base(i) * T_base_laser, planar, seed).points) {
      const long beam = std::lround((std::atan2(p.y(), p.x()) - message.angle_min) / message.angle_increment);
      if (beam >= 0 && beam <= 180) message.ranges[static_cast<std::size_t>(beam)] = p.norm();
    }
    return message;
  }

 private:
  static Pose at(double x, double y, double heading) {
    return Pose(urban_nav_core::Quaterniond(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ())), {x, y, 0.0});
  }
  static const urban_nav_core::testing::World& world() {
    static const urban_nav_core::testing::World courtyard = urban_nav_core::testing::courtyard(4);
    return courtyard;
  }
  ros::Publisher left_ = this->template advertise<sensor_msgs::LaserScan>("laser_left/scan");
  ros::Publisher right_ = this->template advertise<sensor_msgs::LaserScan>("laser_right/scan");
  ros::Publisher tf_static_ = this->template advertise<tf2_msgs::TFMessage>("/tf_static", true);
  Pose T_odom_base_;
  int first_ = kFrames;
  bool scanning_ = false;
};

}  // namespace urban_nav_ros::testing
