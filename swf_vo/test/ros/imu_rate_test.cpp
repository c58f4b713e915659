// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "graph.hpp"
#include "swf_vo/swf_vo.hpp"
#include "urban_nav_ros/motion.hpp"
#include "urban_nav_ros/pose.hpp"

namespace swf_vo::test {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::StereoCamera;
using urban_nav_core::testing::GreyImage;
using urban_nav_core::testing::RenderedSequence;
using urban_nav_ros::toStampNs;

constexpr StampNs kRatePeriod = 5'000'000;  // ns

/// The nodelet with imu_rate, in the namespace `fast`, on a robot with a gyroscope. Camera and IMU are at base_link.
class FastRobot {
 public:
  FastRobot() {
    const auto keep = [this](const std::string& topic, std::vector<nav_msgs::Odometry>& into) {
      return nh_.subscribe<nav_msgs::Odometry>(topic, 5000, [&into](const auto& message) { into.push_back(*message); });
    };
    odometry_ = keep("vo/odometry", odometry);
    frames_ = keep("vo/odometry_at_frames", frames);
  }
  void place() {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(
        urban_nav_ros::toStaticTransform("base_link", "fast_camera", urban_nav_ros::opticalInBody()));
    message.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "fast_imu", Pose()));
    tf_static_.publish(message);
  }
  bool isConnected() const {
    return tf_static_.getNumSubscribers() > 1 && odometry_.getNumPublishers() > 0 && frames_.getNumPublishers() > 0 &&
           imu_.getNumSubscribers() > 0 && left_.getNumSubscribers() > 0 &&
           right_.getNumSubscribers() > 0 && left_info_.getNumSubscribers() > 0 &&
           right_info_.getNumSubscribers() > 0;
  }
  void show(const urban_nav_core::testing::StereoFrame& frame, const StereoCamera& camera) {
    show(left_, left_info_, frame.left, urban_nav_ros::toCameraInfoMessage(leftInfo(camera)), frame.stamp);
    show(right_, right_info_, frame.right, urban_nav_ros::toCameraInfoMessage(rightInfo(camera)), frame.stamp);
  }
  void measure(const sensor_msgs::Imu& message) { imu_.publish(message); }

  std::vector<nav_msgs::Odometry> odometry, frames;

 private:
  static void show(ros::Publisher& images, ros::Publisher& infos, const GreyImage& image, sensor_msgs::CameraInfo info,
                   StampNs stamp) {
    auto pixels = image.pixels;
    sensor_msgs::Image message =
        urban_nav_ros::toImageMessage(cv::Mat(image.height, image.width, CV_8UC1, pixels.data()));
    message.header.stamp = info.header.stamp = urban_nav_ros::toRosTime(stamp);
    message.header.frame_id = info.header.frame_id = "fast_camera";
    infos.publish(info);
    images.publish(message);
  }

  ros::NodeHandle nh_{"/fast"};
  ros::Subscriber odometry_, frames_;
  ros::Publisher left_ = nh_.advertise<sensor_msgs::Image>("stereo/left/image_raw", 1000),
                 right_ = nh_.advertise<sensor_msgs::Image>("stereo/right/image_raw", 1000),
                 left_info_ = nh_.advertise<sensor_msgs::CameraInfo>("stereo/left/camera_info", 1000),
                 right_info_ = nh_.advertise<sensor_msgs::CameraInfo>("stereo/right/camera_info", 1000),
                 tf_static_ = nh_.advertise<tf2_msgs::TFMessage>("/tf_static", 10),
                 imu_ = nh_.advertise<sensor_msgs::Imu>("imu/data", 5000);
};

/// The walk of room(), as poses of base_link at any time.
Pose basePose(const RenderedSequence& sequence, StampNs stamp) {
  const double t = urban_nav_core::secondsBetween(sequence.stamp(0), stamp);
  const Pose T_world_camera = urban_nav_core::testing::loop(3.0, 1.5, 1.2, 25.0)(std::max(0.0, t));
  return T_world_camera * urban_nav_ros::opticalInBody().inverse();
}

sensor_msgs::Imu imuAt(const RenderedSequence& sequence, StampNs stamp) {
  constexpr StampNs kHalf = 500'000;
  const Pose turn = basePose(sequence, stamp - kHalf).inverse() * basePose(sequence, stamp + kHalf);
  const Eigen::Vector3d rate = urban_nav_core::logSo3(turn.q()) / 1e-3;
  sensor_msgs::Imu message;
  message.header.stamp = urban_nav_ros::toRosTime(stamp);
  message.header.frame_id = "fast_imu";
  message.angular_velocity.x = rate.x();
  message.angular_velocity.y = rate.y();
  message.angular_velocity.z = rate.z();
  for (const int i : {0, 4, 8}) message.angular_velocity_covariance[static_cast<std::size_t>(i)] = 1e-6;
  message.orientation_covariance[0] = message.linear_acceleration_covariance[0] = -1.0;  // not measured
  return message;
}

Pose toBasePose(const nav_msgs::Odometry& odometry) { return *urban_nav_ros::toPose(odometry.pose.pose); }

/// Expects the given frames, and poses between them that follow the walk, in the order of time.
void expectPropagated(const std::vector<nav_msgs::Odometry>& odometry, const std::vector<nav_msgs::Odometry>& expected,
                      const RenderedSequence& sequence) {
  std::size_t frames = 0, between = 0;
  std::optional<nav_msgs::Odometry> last_frame, last_between;
  const Pose first = basePose(sequence, sequence.stamp(0));
  for (const nav_msgs::Odometry& message : odometry) {
    EXPECT_EQ(message.child_frame_id, "base_link");
    const auto is_frame = std::any_of(expected.begin(), expected.end(), [&](const nav_msgs::Odometry& frame) {
      return frame.header.stamp == message.header.stamp && frame.pose == message.pose;
    });
    if (is_frame) {
      ++frames;
      last_frame = message;
      continue;
    }
    ++between;
    ASSERT_TRUE(last_frame);
    EXPECT_GT(message.header.stamp, last_frame->header.stamp);
    if (last_between) {
      EXPECT_GT(message.header.stamp, last_between->header.stamp);
    }
    last_between = message;
    const Pose truth = first.inverse() * basePose(sequence, toStampNs(message.header.stamp));
    EXPECT_LT(urban_nav_core::angleBetween(toBasePose(message), truth), 5e-3);
    EXPECT_LT(urban_nav_core::distanceBetween(toBasePose(message), truth), 0.02);
    EXPECT_GT(message.pose.covariance[0], last_frame->pose.covariance[0]);
    EXPECT_GT(message.pose.covariance[35], last_frame->pose.covariance[35]);
    EXPECT_NEAR(message.twist.twist.angular.z, 0.35, 0.25) << "the walk turns left";
  }
  EXPECT_EQ(frames, expected.size());
  // Ten rates a frame, once the images have confirmed the gyroscope for a second.
  EXPECT_GT(between, 150U);
}

TEST(SwfVoNodeletAtImuRate, FramesAreUnchangedAndPosesBetweenThemFollowTheGyroscope) {
  constexpr int kFrames = 50;
  RenderedSequence sequence = room();
  const StereoCamera camera = makeCamera(sequence.options().camera);
  FastRobot robot;
  ASSERT_TRUE(Graph::until([&] { return robot.isConnected(); }));
  robot.place();

  SwfVo filter(Parameters(), camera, urban_nav_ros::opticalInBody());
  urban_nav_ros::GyroMotion gyroscope(0.0, Eigen::Matrix3d::Identity());
  std::vector<urban_nav_core::MotionInput> inputs;
  std::vector<nav_msgs::Odometry> expected;
  StampNs measured = sequence.stamp(0) - kRatePeriod;
  for (int i = 0; i < kFrames; ++i) {
    // Images arrive 20 ms late.
    for (; measured <= sequence.stamp(i) + 4 * kRatePeriod; measured += kRatePeriod) {
      const sensor_msgs::Imu message = imuAt(sequence, measured);
      robot.measure(message);
      if (const auto input = gyroscope.add(message)) inputs.push_back(*input);
    }
    robot.show(sequence.frame(i), camera);
    ASSERT_TRUE(Graph::until([&] { return robot.frames.size() > static_cast<std::size_t>(i); })) << i;
    const auto later = std::find_if(inputs.begin(), inputs.end(),
                                    [&](const auto& input) { return input.to > sequence.stamp(i); });
    const Frame& frame = filter.process(sequence.frame(i).pair(), {inputs.begin(), later});
    inputs.erase(inputs.begin(), later);
    expected.push_back(urban_nav_ros::toOdometryMessage(frame.stamp, frame.T_odom_base, "odom", "base_link"));
  }
  ASSERT_EQ(robot.frames.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(robot.frames[i].header.stamp, expected[i].header.stamp);
    EXPECT_EQ(robot.frames[i].pose, expected[i].pose) << i;
  }

  ASSERT_TRUE(Graph::until([&] {
    return std::any_of(robot.odometry.begin(), robot.odometry.end(),
                       [&](const auto& message) { return message.header.stamp == expected.back().header.stamp; });
  }));
  expectPropagated(robot.odometry, expected, sequence);
}

}  // namespace
}  // namespace swf_vo::test
