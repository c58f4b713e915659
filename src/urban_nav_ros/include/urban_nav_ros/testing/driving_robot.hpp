// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <urban_nav_msgs/RelativePose.h>

#include <string>
#include <vector>

#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/testing/textured_street.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/stereo_listener.hpp"

namespace urban_nav_ros::testing {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;

constexpr StampNs kStart = 1'225'719'873'000'000'000, kEpoch = 1'000'000'000'000;
constexpr int kLap = 24;  // frames around the room

/// Drive around a textured room, with a frame each 0.8 s and 0.6 m.
inline urban_nav_core::testing::RenderedSequence room() {
  using namespace urban_nav_core::testing;
  SequenceOptions options;
  options.rate = 1.25;
  options.first_stamp = kStart;
  return RenderedSequence(texturedRoom(), loop(3.0, 1.5, 1.2, kLap / options.rate), options);
}
/// The drive of room() on another day: slightly offset, in dimmer light.
inline urban_nav_core::testing::RenderedSequence roomOfAnotherDay() {
  using namespace urban_nav_core::testing;
  SequenceOptions options;
  options.rate = 1.25;
  options.first_stamp = kStart + 86'400'000'000'000;
  options.seed = 2;
  options.gain = [](double) { return 0.8; };
  return RenderedSequence(texturedRoom(), loop(2.9, 1.4, 1.15, kLap / options.rate), options);
}
/// Another site.
inline urban_nav_core::testing::RenderedSequence street() {
  using namespace urban_nav_core::testing;
  SequenceOptions options;
  options.rate = 1.25;
  options.first_stamp = kStart + 86'400'000'000'000;
  return RenderedSequence(texturedStreet(), drive(0.75, 1.2), options);
}

inline Pose T_base_left() { return Pose(urban_nav_ros::opticalInBody().q(), Eigen::Vector3d(0.1, 0.06, 1.1)); }

/// ROS environment of a nodelet: a robot with a stereo camera and odometry.
class DrivingRobot : public StereoListener {
 public:
  DrivingRobot(const std::string& node, urban_nav_core::testing::RenderedSequence sequence)
      : StereoListener(node), sequence_(std::move(sequence)) {
    connected_ = until([this] { return isConnected(); });
    place(T_base_left());
  }
  bool connected() const { return connected_; }

  /// Begins another session, later than all before.
  void beginSession() { ++session_; }
  StampNs toStamp(int frame) const { return sequence_.stamp(frame) + session_ * kEpoch; }
  Pose T_world_base(int frame) const { return sequence_.T_world_camera(frame) * T_base_left().inverse(); }
  urban_nav_core::StereoCamera camera() const { return makeCamera(sequence_.options().camera); }
  const urban_nav_core::testing::StereoFrame& frame(int i) { return sequence_.frame(i); }

  /// Publishes frames from ... to - 1 and the odometry between them, except the step that leads to frame `lost`.
  /// Returns once the nodelet has received all.
  void drive(int from, int to, bool images = true, int lost = -1) {
    for (int i = from; i < to; ++i) {
      const bool steps = i > 0 && i != lost;
      if (images) show(i);
      EXPECT_TRUE(receipts().await({{"odometry", 1}, {"odometry/relative_pose", steps ? 1 : 0}}, [&] {
        beAt(toStamp(i), T_world_base(0).inverse() * T_world_base(i));
        if (steps) step(toStamp(i - 1), toStamp(i), T_world_base(i - 1).inverse() * T_world_base(i), 1e-3);
      })) << "odometry of frame "
          << i;
    }
  }
  void beAt(StampNs stamp, const Pose& T_odom_base) {
    nav_msgs::Odometry odometry;
    odometry.header.stamp = urban_nav_ros::toRosTime(stamp);
    odometry.pose.pose = urban_nav_ros::toPoseMessage(T_odom_base);
    odometry_.publish(odometry);
  }
  /// `sigma`: m and rad.
  void step(StampNs from, StampNs to, const Pose& T_from_to, double sigma) {
    urban_nav_core::RelativePose step;
    step.from = from;
    step.to = to;
    step.T_from_to = T_from_to;
    step.covariance = sigma * sigma * urban_nav_core::Matrix6d::Identity();
    step.drift_covariance = 0.5 * step.covariance;
    step.source = "swf_vo";
    relative_.publish(urban_nav_ros::toRelativePoseMessage(step, "base_link"));
  }
  void show(int i) { StereoListener::show(sequence_.frame(i), camera(), toStamp(i)); }
  /// Returns the last value of an entry of the diagnostics.
  std::string diagnosis(const std::string& key) const {
    std::string value;
    for (const auto& array : diagnostics)
      for (const auto& status : array.status)
        for (const auto& entry : status.values)
          if (entry.key == key) value = entry.value;
    return value;
  }

 private:
  ros::Publisher odometry_ = advertise<nav_msgs::Odometry>("odometry");
  ros::Publisher relative_ = advertise<urban_nav_msgs::RelativePose>("odometry/relative_pose");
  urban_nav_core::testing::RenderedSequence sequence_;
  int session_ = 0;
  bool connected_ = false;
};

}  // namespace urban_nav_ros::testing
