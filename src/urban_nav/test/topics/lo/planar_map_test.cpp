// SPDX-License-Identifier: BSD-3-Clause
// `map` of recordings without images and 3D LiDARs: scans of a planar laser, alone and with a depth camera.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parameters.hpp"
#include "commands/stages.hpp"
#include "map/map_pipeline.hpp"
#include "urban_nav_core/io/cloud/cloud_columns.hpp"
#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/bags.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;

constexpr double kRoomStart = 1.5e9, kTurnPeriod = 0.1;  // s
constexpr int kTurns = 60, kBeamsOfTurn = 720;

/// Drives an arc of 0.6 m/s and 0.15 rad/s.
Pose robotAt(double t) {
  urban_nav_core::Vector6d twist;
  twist << 0.6, 0, 0, 0, 0, 0.15;
  return Pose(Eigen::Quaterniond::Identity(), {-3.0, -1.0, 0.0}) * urban_nav_core::expSe3(t * twist);
}

/// Distance to the walls of a room of 12 x 9 m, or to a box in it, along a unit direction.
double rangeInRoom(const Vector3d& p, const Vector3d& d) {
  const double x = d.x() > 0.0 ? (6.0 - p.x()) / d.x() : (-6.0 - p.x()) / d.x();
  const double y = d.y() > 0.0 ? (4.5 - p.y()) / d.y() : (-4.5 - p.y()) / d.y();
  const double ax = (2.0 - p.x()) / d.x(), bx = (3.0 - p.x()) / d.x(), ay = (2.5 - p.y()) / d.y(),
               by = (3.5 - p.y()) / d.y();
  const double enter = std::max(std::min(ax, bx), std::min(ay, by));
  const double leave = std::min(std::max(ax, bx), std::max(ay, by));
  return enter > 0.0 && enter < leave ? enter : std::min(x, y);
}

std::string writeRoom(const TemporaryFolder& folder, const Pose& T_base_laser) {
  const std::string path = folder.file("room.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage places;
  places.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "laser", T_base_laser));
  bag.write("/tf_static", ros::Time(kRoomStart), places);
  for (int i = 0; i < kTurns; ++i) {
    sensor_msgs::LaserScan scan;
    scan.header.stamp = ros::Time(kRoomStart + kTurnPeriod * i);
    scan.header.frame_id = "laser";
    scan.angle_min = static_cast<float>(-M_PI);
    scan.angle_increment = static_cast<float>(2.0 * M_PI / kBeamsOfTurn);
    scan.angle_max = scan.angle_min + scan.angle_increment * (kBeamsOfTurn - 1);
    scan.time_increment = static_cast<float>(kTurnPeriod / kBeamsOfTurn);
    scan.scan_time = static_cast<float>(kTurnPeriod);
    scan.range_min = 0.1F;
    scan.range_max = 30.0F;
    for (int k = 0; k < kBeamsOfTurn; ++k) {
      const double angle = -M_PI + 2.0 * M_PI * k / kBeamsOfTurn;
      const Pose T = robotAt(kTurnPeriod * (i + static_cast<double>(k) / kBeamsOfTurn)) * T_base_laser;
      const Vector3d d = T.q() * Vector3d(std::cos(angle), std::sin(angle), 0.0);
      scan.ranges.push_back(static_cast<float>(rangeInRoom(T.t(), d) + 0.004 * std::sin(37.0 * k + 11.0 * i)));
    }
    bag.write("/scan", scan.header.stamp + ros::Duration(kTurnPeriod), scan);
  }
  return path;
}

const Pose kDepthCamera(urban_nav_core::Quaterniond(0.5, -0.5, 0.5, -0.5), {0.3, -0.1, 0.9});
constexpr int kDepthWidth = 64, kDepthHeight = 48;
constexpr double kDepthFocal = 55.0;  // px

/// Returns what a depth camera measures at the pose of the robot: whole millimetres, no ground.
sensor_msgs::Image depthOfRoom(const ros::Time& stamp, const Pose& T_map_base) {
  sensor_msgs::Image image;
  image.header.stamp = stamp;
  image.header.frame_id = "depth_optical";
  image.encoding = "16UC1";
  image.width = kDepthWidth;
  image.height = kDepthHeight;
  image.step = 2 * kDepthWidth;
  const Pose T = T_map_base * kDepthCamera;
  for (int v = 0; v < kDepthHeight; ++v)
    for (int u = 0; u < kDepthWidth; ++u) {
      const Vector3d ray((u - 31.5) / kDepthFocal, (v - 23.5) / kDepthFocal, 1.0);
      const auto mm = static_cast<unsigned>(1e3 * rangeInRoom(T.t(), T.q() * ray.normalized()) / ray.norm() + 0.5);
      image.data.push_back(static_cast<std::uint8_t>(mm & 0xFFU));
      image.data.push_back(static_cast<std::uint8_t>(mm >> 8U));
    }
  return image;
}

/// Adds ten images a second of a depth camera to the recording of writeRoom().
void addDepth(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Append);
  tf2_msgs::TFMessage places;
  places.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "depth_optical", kDepthCamera));
  bag.write("/tf_static", ros::Time(kRoomStart), places);
  sensor_msgs::CameraInfo info;
  info.width = kDepthWidth;
  info.height = kDepthHeight;
  info.K = {kDepthFocal, 0, 31.5, 0, kDepthFocal, 23.5, 0, 0, 1};
  info.P = {kDepthFocal, 0, 31.5, 0, 0, kDepthFocal, 23.5, 0, 0, 0, 1, 0};
  for (int i = 0; i < kTurns; ++i) {
    const ros::Time stamp(kRoomStart + kTurnPeriod * (i + 0.4));
    bag.write("/camera/depth/image_rect_raw", stamp, depthOfRoom(stamp, robotAt(kTurnPeriod * (i + 0.4))));
    info.header.stamp = stamp;
    bag.write("/camera/depth/camera_info", stamp, info);
  }
}

constexpr int kColourWidth = 80, kColourHeight = 60;
constexpr double kColourFocal = 40.0;  // px

/// Colour of the wall at a point: red ahead, green at the back, blue at the sides, grey of the box.
std::array<std::uint8_t, 3> wallColour(const Vector3d& p) {
  if (std::abs(p.x() - 6.0) < 1e-6) return {200, 30, 30};
  if (std::abs(p.x() + 6.0) < 1e-6) return {30, 200, 30};
  if (std::abs(std::abs(p.y()) - 4.5) < 1e-6) return {30, 30, 200};
  return {120, 120, 120};
}

/// Adds five colour images a second of a camera that faces the left, to the recording of writeRoom().
void addColour(const std::string& path) {
  const Pose mounting(urban_nav_core::Quaterniond(Eigen::AngleAxisd(0.8, Vector3d::UnitZ())) * kDepthCamera.q(),
                      {0.1, 0.2, 0.5});
  rosbag::Bag bag(path, rosbag::bagmode::Append);
  tf2_msgs::TFMessage places;
  places.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "colour_optical", mounting));
  bag.write("/tf_static", ros::Time(kRoomStart), places);
  sensor_msgs::CameraInfo info;
  info.width = kColourWidth;
  info.height = kColourHeight;
  info.K = {kColourFocal, 0, 39.5, 0, kColourFocal, 29.5, 0, 0, 1};
  for (int i = 0; i < kTurns; i += 2) {
    const double t = kTurnPeriod * (i + 0.7);
    const Pose T = robotAt(t) * mounting;
    sensor_msgs::Image image;
    image.header.stamp = ros::Time(kRoomStart + t);
    image.header.frame_id = "colour_optical";
    image.encoding = "rgb8";
    image.width = kColourWidth;
    image.height = kColourHeight;
    image.step = 3 * kColourWidth;
    for (int v = 0; v < kColourHeight; ++v)
      for (int u = 0; u < kColourWidth; ++u) {
        const Vector3d ray = T.q() * Vector3d((u - 39.5) / kColourFocal, (v - 29.5) / kColourFocal, 1.0).normalized();
        const auto colour = wallColour(T.t() + rangeInRoom(T.t(), ray) * ray);
        image.data.insert(image.data.end(), colour.begin(), colour.end());
      }
    info.header.stamp = image.header.stamp;
    bag.write("/front/color/image_raw", image.header.stamp, image);
    bag.write("/front/color/camera_info", image.header.stamp, info);
  }
}

/// Distance of a point to the walls of the room and of the box.
double distanceToWalls(const Vector3d& p) {
  const double room = std::min(std::abs(std::abs(p.x()) - 6.0), std::abs(std::abs(p.y()) - 4.5));
  const double dx = std::abs(p.x() - 2.5) - 0.5, dy = std::abs(p.y() - 3.0) - 0.5;
  const double box = dx > 0.0 && dy > 0.0 ? std::hypot(dx, dy) : std::abs(std::max(dx, dy));
  return std::min(room, box);
}

void mapRoom(const std::string& bag, const std::string& out, int threads, const std::vector<std::string>& stages) {
  const Arguments none({}, addStageTables);
  MapOptions request{{bag}, out, stages, "", "", "", {}, loadParameters(none), threads};
  request.odometry = OdometryOption::Laser;
  Console console;
  runMap(request, makeStages(), console);
}

TEST(PlanarMap, ARoomIsMappedFromTheScansOfAHorizontalLaser) {
  const TemporaryFolder folder;
  const std::string bag = writeRoom(folder, Pose(urban_nav_core::expSo3({0.0, 0.0, 0.4}), {0.2, 0.05, 0.3}));
  mapRoom(bag, folder.file("out"), 1, {});
  const urban_nav_core::Trajectory trajectory = urban_nav_core::readTum(folder.file("out/trajectory.tum"));
  ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(kTurns));
  const auto truth = [](urban_nav_core::StampNs stamp) {
    return robotAt(1e-9 * static_cast<double>(stamp - static_cast<urban_nav_core::StampNs>(1e9 * kRoomStart)));
  };
  const Pose expected = truth(trajectory[0].stamp).inverse() * truth(trajectory[kTurns - 1].stamp);
  EXPECT_LT(distanceBetween(trajectory[kTurns - 1].pose, expected), 0.01);
  EXPECT_LT(urban_nav_core::angleBetween(trajectory[kTurns - 1].pose, expected), 0.003);
  EXPECT_NE(readFile(folder.file("out/sweeps.csv")).find(",OK,planar,"), std::string::npos);
  const std::string summary = readFile(folder.file("out/summary.json"));
  EXPECT_NE(summary.find("planar motion only: height, roll and pitch are assumed"), std::string::npos);
  EXPECT_NE(summary.find("\"role\": \"laser0\""), std::string::npos);
  EXPECT_FALSE(readFile(folder.file("out/map.ply")).empty());

  mapRoom(bag, folder.file("two"), 2, {});
  for (const char* name : {"trajectory.tum", "covariance.csv", "sweeps.csv", "map.ply"})
    EXPECT_EQ(readFile(folder.file("two/") + name), readFile(folder.file("out/") + name)) << name;
}

TEST(PlanarMap, ADepthCameraAddsItsSurfaces) {
  const TemporaryFolder folder;
  const std::string bag = writeRoom(folder, Pose(urban_nav_core::expSo3({0.0, 0.0, 0.4}), {0.2, 0.05, 0.3}));
  addDepth(bag);
  mapRoom(bag, folder.file("out"), 1, {});
  const std::string map = folder.file("out/map.ply");
  EXPECT_NE(readFile(map).find("comment sensor 123 depth0 depth_optical\n"), std::string::npos);
  EXPECT_NE(readFile(map).find("comment sensor 2 laser0 laser\n"), std::string::npos);
  const urban_nav_core::PointCloud cloud = urban_nav_core::readCloud(map).cloud;
  std::vector<double> errors;
  const urban_nav_core::Trajectory trajectory = urban_nav_core::readTum(folder.file("out/trajectory.tum"));
  const double first = 1e-9 * static_cast<double>(trajectory[0].stamp) - kRoomStart;
  for (const Eigen::Vector3f& p : cloud.points)
    if (p.z() > 0.6F) errors.push_back(distanceToWalls(robotAt(first) * p.cast<double>()));  // above the laser
  ASSERT_GT(errors.size(), 1000U);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.01);
  EXPECT_LT(errors[errors.size() * 95 / 100], 0.05);
  const std::string summary = readFile(folder.file("out/summary.json"));
  EXPECT_NE(summary.find("\"role\": \"depth0\""), std::string::npos);
  EXPECT_NE(summary.find("\"depth0\":"), std::string::npos) << "points_by_sensor";

  mapRoom(bag, folder.file("two"), 2, {});
  EXPECT_EQ(readFile(folder.file("two/map.ply")), readFile(map));
}

TEST(PlanarMap, ACameraColoursThePointsThatItShows) {
  const TemporaryFolder folder;
  const std::string bag = writeRoom(folder, Pose(urban_nav_core::expSo3({0.0, 0.0, 0.4}), {0.2, 0.05, 0.3}));
  addColour(bag);
  mapRoom(bag, folder.file("out"), 1, {});
  const std::string map = folder.file("out/map.ply");
  const urban_nav_core::NumberColumns columns =
      urban_nav_core::readCloudColumns(map, {"x", "y", "z", "red", "blue", "coloured"});
  for (const auto& column : columns) ASSERT_TRUE(column.has_value());
  const urban_nav_core::Trajectory trajectory = urban_nav_core::readTum(folder.file("out/trajectory.tum"));
  const Pose T_room_map = robotAt(1e-9 * static_cast<double>(trajectory[0].stamp) - kRoomStart);
  std::size_t red = 0, blue = 0, wrong = 0;
  for (std::size_t i = 0; i < columns[0]->size(); ++i) {
    const auto value = [&](std::size_t column) { return (*columns[column])[i]; };
    if (value(5) == 0.0) continue;
    const Vector3d p = T_room_map * Vector3d(value(0), value(1), value(2));
    const bool is_ahead = std::abs(p.x() - 6.0) < 0.1 && std::abs(p.y()) < 4.2;
    const bool is_side = std::abs(std::abs(p.y()) - 4.5) < 0.1 && std::abs(p.x()) < 5.7;
    const bool is_red = value(3) > 2.0 * value(4), is_blue = value(4) > 2.0 * value(3);
    red += is_ahead && is_red ? 1 : 0;
    blue += is_side && is_blue ? 1 : 0;
    wrong += (is_ahead && !is_red) || (is_side && !is_blue) ? 1 : 0;
  }
  EXPECT_GT(red, 100U);
  EXPECT_GT(blue, 100U);
  EXPECT_LT(wrong, (red + blue) / 100);
  EXPECT_NE(readFile(folder.file("out/summary.json")).find("\"role\": \"colour0\""), std::string::npos);

  mapRoom(bag, folder.file("two"), 2, {});
  EXPECT_EQ(readFile(folder.file("two/map.ply")), readFile(map));
}

TEST(PlanarMap, AVerticalLaserIsRefusedWithTheReason) {
  const TemporaryFolder folder;
  const std::string bag = writeRoom(folder, Pose(urban_nav_core::expSo3({M_PI / 2.0, 0.0, 0.0}), {0.0, 0.0, 0.3}));
  try {
    mapRoom(bag, folder.file("out"), 1, {"lo"});
    FAIL();
  } catch (const urban_nav_core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find("/scan by 90 deg"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("none of their scans measures again"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace urban_nav
