// SPDX-License-Identifier: BSD-3-Clause
#include <geometry_msgs/PointStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>
#include <urban_nav_msgs/CorrectLabel.h>
#include <urban_nav_msgs/FileCommand.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/StageStatus.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <opencv2/core.hpp>
#include <string>

#include "scene_labeler/classes.hpp"
#include "urban_nav_core/laser/cloud/cloud_survey.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/listener.hpp"
#include "urban_nav_ros/testing/receipts.hpp"

namespace scene_labeler {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

constexpr StampNs kStreetStart = 1'225'719'872'000'000'000;
constexpr int kStreetFrames = 160;  // of 50 ms and 5 cm
constexpr int kColumns = 96, kRows = 128;

/// Robot that drives along x beside a wall at y = 4, with a laser and a camera facing left.
class StreetRobot : public urban_nav_ros::testing::Listener {
 public:
  StreetRobot() : Listener("scene_labeler") {
    keep("labels/cloud", clouds);
    keep("labels/image", images);
    keep("scene_labeler/status", statuses);
  }
  static StampNs toStamp(int frame) { return kStreetStart + frame * 50'000'000LL; }

  /// Returns once the nodelet has received it, as below: scans and images have separate connections.
  void placeSensors() {
    Eigen::Matrix3d R_laser, R_camera;
    R_laser << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    R_camera << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // x along the street, z to the left
    tf2_msgs::TFMessage message;
    message.transforms.push_back(
        urban_nav_ros::toStaticTransform("base_link", "laser_left", Pose(R_laser, Vector3d(0.0, 0.2, 1.0))));
    message.transforms.push_back(
        urban_nav_ros::toStaticTransform("base_link", "camera4", Pose(R_camera, Vector3d(0.0, 0.0, 1.2))));
    EXPECT_TRUE(receipts_.await({{"/tf_static", 1}}, [&] { tf_static_.publish(message); }));
  }
  void calibrate() {
    sensor_msgs::CameraInfo info;
    info.header.frame_id = "camera4";
    info.width = kColumns;
    info.height = kRows;
    info.distortion_model = "plumb_bob";
    info.D.assign(5, 0.0);
    info.K = {60.0, 0.0, 48.0, 0.0, 60.0, 64.0, 0.0, 0.0, 1.0};
    info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    info.P = {60.0, 0.0, 48.0, 0.0, 0.0, 60.0, 64.0, 0.0, 0.0, 0.0, 1.0, 0.0};
    EXPECT_TRUE(receipts_.await({{"ladybug/camera4/camera_info", 1}}, [&] { info_.publish(info); }));
  }
  void drive() {
    for (int i = 0; i < kStreetFrames; ++i) {
      nav_msgs::Odometry odometry;
      odometry.header.stamp = urban_nav_ros::toRosTime(toStamp(i));
      odometry.pose.pose =
          urban_nav_ros::toPoseMessage(Pose(Eigen::Matrix3d::Identity(), Vector3d(0.05 * i, 0.0, 0.0)));
      const bool scans = i > 0, shows = i % 10 == 5;
      EXPECT_TRUE(
          receipts_.await({{"laser_left/scan", scans ? 1 : 0}, {"ladybug/camera4/image_raw", shows ? 1 : 0}}, [&] {
            if (scans) left_.publish(scan(toStamp(i)));
            if (shows) show(toStamp(i));
          }));
      EXPECT_TRUE(receipts_.await({{"odometry", 1}}, [&] { odometry_.publish(odometry); }));
    }
  }
  std::size_t points() const {
    std::size_t all = 0;
    for (const auto& cloud : clouds) all += cloud.width * cloud.height;
    return all;
  }

  void click(const std::string& frame, float x, float y, float z) {
    geometry_msgs::PointStamped message;
    message.header.frame_id = frame;
    message.point.x = x;
    message.point.y = y;
    message.point.z = z;
    EXPECT_TRUE(receipts_.await({{"/clicked_point", 1}}, [&] { click_.publish(message); }));
  }
  static urban_nav_msgs::CorrectLabel::Response correct(const std::string& label) {
    urban_nav_msgs::CorrectLabel service;
    service.request.label = label;
    EXPECT_TRUE(ros::service::call("scene_labeler/correct", service));
    return service.response;
  }
  /// Waits until the response to a correction contains `part`: clicks and services are handled by different threads.
  static bool answers(const std::string& part) {
    return until([&part] { return correct("dirt_path").message.find(part) != std::string::npos; });
  }

  std::vector<sensor_msgs::PointCloud2> clouds;
  std::vector<sensor_msgs::Image> images;
  std::vector<urban_nav_msgs::StageStatus> statuses;

 private:
  void show(StampNs stamp) {
    sensor_msgs::Image message =
        urban_nav_ros::toColourImageMessage(cv::Mat(kRows, kColumns, CV_8UC3, cv::Scalar(90, 110, 130)));
    message.header.stamp = urban_nav_ros::toRosTime(stamp);
    message.header.frame_id = "camera4";
    image_.publish(message);
  }
  static sensor_msgs::LaserScan scan(StampNs stamp) {
    sensor_msgs::LaserScan message;
    message.header.stamp = urban_nav_ros::toRosTime(stamp);
    message.header.frame_id = "laser_left";
    message.angle_min = static_cast<float>(-60.0 * M_PI / 180.0);
    message.angle_max = static_cast<float>(40.0 * M_PI / 180.0);
    message.angle_increment = static_cast<float>(M_PI / 180.0);
    message.range_min = 0.1F;
    message.range_max = 30.0F;
    for (int degrees = -60; degrees <= 40; ++degrees) {
      const double angle = degrees * M_PI / 180.0;
      const double ground = angle < 0.0 ? 1.0 / std::sin(-angle) : std::numeric_limits<double>::infinity();
      message.ranges.push_back(static_cast<float>(std::min(3.8 / std::cos(angle), ground)));
      message.intensities.push_back(60.0F);
    }
    return message;
  }

  const urban_nav_ros::testing::Receipts receipts_{"scene_labeler"};
  ros::Publisher tf_static_ = advertise<tf2_msgs::TFMessage>("/tf_static", true);
  ros::Publisher odometry_ = advertise<nav_msgs::Odometry>("odometry");
  ros::Publisher relative_ = advertise<urban_nav_msgs::RelativePose>("odometry/relative_pose");
  ros::Publisher left_ = advertise<sensor_msgs::LaserScan>("laser_left/scan");
  ros::Publisher right_ = advertise<sensor_msgs::LaserScan>("laser_right/scan");
  ros::Publisher image_ = advertise<sensor_msgs::Image>("ladybug/camera4/image_raw");
  ros::Publisher click_ = advertise<geometry_msgs::PointStamped>("/clicked_point");
  ros::Publisher info_ = advertise<sensor_msgs::CameraInfo>("ladybug/camera4/camera_info");
};

TEST(SceneLabelerNodelet, LabelsReturnsVisibleInTheCameraOfTheirSide) {
  StreetRobot robot;
  ASSERT_TRUE(StreetRobot::until([&] { return robot.isConnected(); }));
  robot.placeSensors();
  robot.calibrate();
  robot.drive();
  ASSERT_TRUE(StreetRobot::until([&] { return robot.points() > 4000 && robot.images.size() > 2; }))
      << robot.points() << " points, " << robot.images.size() << " images";
  EXPECT_EQ(robot.clouds.back().header.frame_id, "odom");
  EXPECT_EQ(robot.images.back().encoding, "mono8");
  EXPECT_EQ(robot.images.back().header.frame_id, "camera4");
  EXPECT_EQ(robot.images.back().width, static_cast<unsigned>(kColumns));
  sensor_msgs::PointCloud2ConstIterator<float> x(robot.clouds.front(), "x"), p(robot.clouds.front(), "probability");
  sensor_msgs::PointCloud2ConstIterator<std::uint8_t> label(robot.clouds.front(), "label");
  for (; x != x.end(); ++x, ++p, ++label) {
    ASSERT_TRUE(std::abs(x[1] - 4.0F) < 0.05F || std::abs(x[2]) < 0.05F) << "neither wall nor ground";
    ASSERT_TRUE(p[0] > 0.1F && p[0] <= 1.0F);
    ASSERT_LT(label[0], kClassCount);
  }
  EXPECT_NE(StreetRobot::correct("gravel").message.find("paved"), std::string::npos) << "the classes are named";
  EXPECT_FALSE(StreetRobot::correct("dirt_path").success) << "no point was clicked";
  const sensor_msgs::PointCloud2 last_cloud = robot.clouds.back();
  const sensor_msgs::PointCloud2ConstIterator<float> last(last_cloud, "x");
  robot.click("map", last[0], last[1], last[2]);
  EXPECT_TRUE(StreetRobot::answers("odom")) << "another frame";
  robot.click("odom", last[0], last[1], last[2] + 20.0F);
  EXPECT_TRUE(StreetRobot::answers("has a return within 0.3 m")) << "no point there";
  robot.click("odom", last[0], last[1], last[2]);
  EXPECT_TRUE(StreetRobot::until([] { return StreetRobot::correct("dirt_path").success; }));
  EXPECT_TRUE(StreetRobot::until([&] { return robot.diagnosed("corrections", "1"); }));
  urban_nav_msgs::FileCommand save;
  save.request.path = "/tmp/scene_labeler_nodelet_test_" + std::to_string(::getpid()) + ".labels";
  ASSERT_TRUE(ros::service::call("scene_labeler/save", save));
  EXPECT_TRUE(save.response.success) << save.response.message;
  EXPECT_EQ(std::remove(save.request.path.c_str()), 0);
  ASSERT_TRUE(robot.call("reset"));
  robot.diagnostics.clear();  // those of the beginning had no frames either
  ASSERT_TRUE(StreetRobot::until([&] { return robot.diagnosed("frames labelled", "0"); }));
}

/// The robot with a 3D LiDAR in place of laser and camera: 16 rings of a degree, and a wall at y = 4.
class LidarRobot : public urban_nav_ros::testing::Listener {
 public:
  LidarRobot() : Listener("scene_labeler") { keep("labels/cloud", clouds); }
  static StampNs toStamp(int sweep) { return kStreetStart + (1000 + sweep) * 100'000'000LL; }

  /// Publishes sweeps. Those after the first ones, which wait until their conventions are known, wait for the labels of
  /// as many: a busy stage leaves sweeps out.
  void drive(int sweeps) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(urban_nav_ros::toStaticTransform(
        "base_link", "lidar", Pose(Eigen::Matrix3d::Identity(), Vector3d(0.0, 0.0, kHeight))));
    EXPECT_TRUE(receipts_.await({{"/tf_static", 1}}, [&] { tf_static_.publish(message); }));
    for (int i = 0; i < sweeps; ++i) {
      nav_msgs::Odometry odometry;
      odometry.header.stamp = urban_nav_ros::toRosTime(toStamp(i));
      odometry.pose.pose = urban_nav_ros::toPoseMessage(Pose(Eigen::Matrix3d::Identity(), Vector3d(0.1 * i, 0.0, 0.0)));
      EXPECT_TRUE(receipts_.await({{"odometry", 1}}, [&] { odometry_.publish(odometry); }));
      EXPECT_TRUE(receipts_.await({{"points", 1}}, [&] { points_.publish(sweep(toStamp(i))); }));
      const int labelled = i + 1 - static_cast<int>(urban_nav_core::CloudSurvey::kEnough);
      ASSERT_TRUE(until([&] { return static_cast<int>(clouds.size()) >= labelled; })) << "no labels after sweep " << i;
    }
  }

  std::vector<sensor_msgs::PointCloud2> clouds;

 private:
  static constexpr double kHeight = 1.5;  // m

  static sensor_msgs::PointCloud2 sweep(StampNs end) {
    sensor_msgs::PointCloud2 cloud;
    cloud.header.stamp = urban_nav_ros::toRosTime(end);
    cloud.header.frame_id = "lidar";
    sensor_msgs::PointCloud2Modifier modifier(cloud);
    using sensor_msgs::PointField;
    modifier.setPointCloud2Fields(5, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1,
                                  PointField::FLOAT32, "time", 1, PointField::FLOAT32, "ring", 1, PointField::UINT16);
    modifier.resize(16 * 360);
    sensor_msgs::PointCloud2Iterator<float> x(cloud, "x"), time(cloud, "time");
    sensor_msgs::PointCloud2Iterator<std::uint16_t> ring(cloud, "ring");
    for (int column = 0; column < 360; ++column)
      for (int i = 0; i < 16; ++i, ++x, ++time, ++ring) {
        const double azimuth = M_PI - column * M_PI / 180.0, elevation = (i - 12) * M_PI / 180.0;
        const Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                           std::sin(elevation));
        double range = 0.0;  // no return
        if (ray.z() < 0.0) range = -kHeight / ray.z();
        if (ray.y() > 0.0) range = range > 0.0 ? std::min(range, 4.0 / ray.y()) : 4.0 / ray.y();
        for (int axis = 0; axis < 3; ++axis) x[axis] = static_cast<float>(range < 60.0 ? range * ray[axis] : 0.0);
        *time = static_cast<float>(0.1 * (column / 360.0 - 1.0));
        *ring = static_cast<std::uint16_t>(i);
      }
    return cloud;
  }

  const urban_nav_ros::testing::Receipts receipts_{"scene_labeler"};
  ros::Publisher tf_static_ = advertise<tf2_msgs::TFMessage>("/tf_static", true);
  ros::Publisher odometry_ = advertise<nav_msgs::Odometry>("odometry");
  ros::Publisher points_ = advertise<sensor_msgs::PointCloud2>("points");
};

TEST(SceneLabelerNodelet, LabelsTheSweepsOfALidar) {
  constexpr int kSweeps = 30;
  LidarRobot robot;
  ASSERT_TRUE(LidarRobot::until([&] { return robot.isConnected(); }));
  ASSERT_NO_FATAL_FAILURE(robot.drive(kSweeps));
  EXPECT_TRUE(LidarRobot::until([&] { return robot.diagnosed("sweeps", std::to_string(kSweeps)); }));
  const sensor_msgs::PointCloud2 cloud = robot.clouds.back();
  EXPECT_EQ(cloud.header.frame_id, "odom");
  EXPECT_GT(cloud.width, 2000U);
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), p(cloud, "probability");
  sensor_msgs::PointCloud2ConstIterator<std::uint8_t> label(cloud, "label");
  for (; x != x.end(); ++x, ++p, ++label) {
    ASSERT_TRUE(std::abs(x[1] - 4.0F) < 0.05F || std::abs(x[2]) < 0.05F) << "neither wall nor ground";
    ASSERT_TRUE(p[0] > 0.1F && p[0] <= 1.0F);
    ASSERT_LT(label[0], kClassCount);
  }
}

TEST(SceneLabelerNodelet, ASilentOdometryIsNamed) {
  StreetRobot robot;
  ASSERT_TRUE(StreetRobot::until([&] { return robot.isConnected(); }));
  ASSERT_TRUE(
      StreetRobot::until([&] { return !robot.statuses.empty() && robot.statuses.back().reason_name == "NoOdometry"; }));
  EXPECT_EQ(robot.statuses.back().status, urban_nav_msgs::StageStatus::DEGRADED);
}

}  // namespace
}  // namespace scene_labeler

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "scene_labeler_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
