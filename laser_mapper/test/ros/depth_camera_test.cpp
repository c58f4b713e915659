// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/StageStatus.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/listener.hpp"
#include "urban_nav_ros/testing/receipts.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

constexpr std::uint32_t kDepthWidth = 64, kDepthHeight = 48;
constexpr std::uint16_t kWallDepth = 4000;  // mm

/// Robot that drives along x past a wall at y = 4, which its depth camera faces.
class DepthRobot : public urban_nav_ros::testing::Listener {
 public:
  DepthRobot() : Listener("laser_mapper") {
    keep("map/cloud", clouds);
    keep("laser_mapper/status", statuses);
  }

  void placeCamera() {
    Eigen::Matrix3d R;
    R << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    tf2_msgs::TFMessage message;
    message.transforms.push_back(
        urban_nav_ros::toStaticTransform("base_link", "depth_optical_frame", Pose(R, Vector3d(0.0, 0.0, 1.0))));
    EXPECT_TRUE(receipts_.await({{"/tf_static", 1}}, [&] { tf_static_.publish(message); }));
  }
  void calibrate() {
    sensor_msgs::CameraInfo info;
    info.width = kDepthWidth;
    info.height = kDepthHeight;
    info.K = {130.0, 0.0, 31.5, 0.0, 130.0, 23.5, 0.0, 0.0, 1.0};
    info.P = {130.0, 0.0, 31.5, 0.0, 0.0, 130.0, 23.5, 0.0, 0.0, 0.0, 1.0, 0.0};
    info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    EXPECT_TRUE(receipts_.await({{"depth0/camera_info", 1}}, [&] { info_.publish(info); }));
  }
  void drive(int frames) {
    for (int i = 0; i < frames; ++i) {
      const ros::Time stamp = toStamp(i);
      if (i > 0) {
        urban_nav_core::RelativePose step;
        step.from = urban_nav_ros::toStampNs(toStamp(i - 1));
        step.to = urban_nav_ros::toStampNs(stamp);
        step.T_from_to = Pose(Eigen::Matrix3d::Identity(), Vector3d(0.1, 0.0, 0.0));
        step.covariance = 1e-6 * urban_nav_core::Matrix6d::Identity();
        relative_.publish(urban_nav_ros::toRelativePoseMessage(step, "base_link"));
      }
      nav_msgs::Odometry odometry;
      odometry.header.stamp = stamp;
      odometry.pose.pose = urban_nav_ros::toPoseMessage(Pose(Eigen::Matrix3d::Identity(), Vector3d(0.1 * i, 0, 0)));
      EXPECT_TRUE(receipts_.await({{"odometry", 1}}, [&] { odometry_.publish(odometry); }));
      EXPECT_TRUE(receipts_.await({{"depth0/image_raw", 1}}, [&] { image_.publish(image(stamp)); }));
    }
  }
  bool showsWall(std::size_t least) const {
    if (clouds.empty() || clouds.back().width < least) return false;
    for (sensor_msgs::PointCloud2ConstIterator<float> p(clouds.back(), "x"); p != p.end(); ++p)
      if (std::abs(p[1] - 4.0F) > 0.03F) return false;
    return true;
  }

  std::vector<sensor_msgs::PointCloud2> clouds;
  std::vector<urban_nav_msgs::StageStatus> statuses;

 private:
  static ros::Time toStamp(int frame) {
    return {1'225'720'000U + static_cast<unsigned>(frame) / 10, 100'000'000U * (static_cast<unsigned>(frame) % 10)};
  }
  static sensor_msgs::Image image(const ros::Time& stamp) {
    sensor_msgs::Image message;
    message.header.stamp = stamp;
    message.header.frame_id = "depth_optical_frame";
    message.width = kDepthWidth;
    message.height = kDepthHeight;
    message.step = 2 * kDepthWidth;
    message.encoding = "16UC1";
    const std::vector<std::uint16_t> depths(kDepthWidth * kDepthHeight, kWallDepth);
    message.data.resize(2 * depths.size());
    std::memcpy(message.data.data(), depths.data(), message.data.size());
    return message;
  }

  const urban_nav_ros::testing::Receipts receipts_{"laser_mapper"};
  ros::Publisher tf_static_ = advertise<tf2_msgs::TFMessage>("/tf_static", true);
  ros::Publisher odometry_ = advertise<nav_msgs::Odometry>("odometry");
  ros::Publisher relative_ = advertise<urban_nav_msgs::RelativePose>("odometry/relative_pose");
  ros::Publisher info_ = advertise<sensor_msgs::CameraInfo>("depth0/camera_info");
  ros::Publisher image_ = advertise<sensor_msgs::Image>("depth0/image_raw");
};

TEST(LaserMapperNodelet, ADepthCameraMakesTheMapOnceItsCalibrationAndMountingAreKnown) {
  DepthRobot robot;
  ASSERT_TRUE(DepthRobot::until([&] { return robot.isConnected(); }));
  ASSERT_TRUE(robot.call("clear"));
  robot.drive(2);
  ASSERT_TRUE(DepthRobot::until([&] {
    return !robot.statuses.empty() && robot.statuses.back().message.find("depth0/camera_info") != std::string::npos;
  })) << "images without calibration";
  robot.calibrate();
  robot.drive(2);
  ASSERT_TRUE(DepthRobot::until([&] {
    return robot.statuses.back().message == "no static tf from base_link to depth_optical_frame";
  })) << robot.statuses.back().message;
  robot.placeCamera();
  ASSERT_TRUE(robot.call("clear"));
  robot.drive(40);
  ASSERT_TRUE(DepthRobot::until([&] { return robot.showsWall(500); })) << robot.clouds.size() << " clouds";
}

}  // namespace
}  // namespace laser_mapper
