// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/FileCommand.h>
#include <urban_nav_msgs/GraphUpdate.h>
#include <urban_nav_msgs/MapQuality.h>
#include <urban_nav_msgs/MapTile.h>
#include <urban_nav_msgs/RelativeConstraint.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/StageStatus.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <optional>

#include "../support/room_rounds.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/graph.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/listener.hpp"
#include "urban_nav_ros/testing/receipts.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

constexpr StampNs kDriveStart = 1'225'719'872'000'000'000;
constexpr int kFrames = 100;  // of 50 ms and 5 cm

/// Robot that drives along x beside a wall at y = 4; its left laser is 1 m above the ground and faces left.
class WallRobot : public urban_nav_ros::testing::Listener {
 public:
  WallRobot() : Listener("laser_mapper") {
    keep("map/cloud", clouds);
    keep("map/quality", qualities);
    keep("map/tiles", tiles);
    keep("map/constraints", constraints);
    keep("map/grid", grids);
    keep("map/traversability", costs);
    keep("map/terrain", terrains);
    keep("laser_mapper/status", statuses);
  }
  static StampNs toStamp(int frame) { return kDriveStart + frame * 50'000'000LL; }
  static Pose T_odom_base(int frame) { return Pose(Eigen::Matrix3d::Identity(), Vector3d(0.05 * frame, 0.0, 0.0)); }

  /// Returns once the nodelet has received it: scans have a separate connection.
  void placeLaser() {
    Eigen::Matrix3d R;
    R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    tf2_msgs::TFMessage message;
    message.transforms.push_back(
        urban_nav_ros::toStaticTransform("base_link", "laser_left", Pose(R, Vector3d(0.0, 0.0, 1.0))));
    EXPECT_TRUE(receipts_.await({{"/tf_static", 1}}, [&] { tf_static_.publish(message); }));
  }
  void drive() {
    for (int i = 0; i < kFrames; ++i) {
      nav_msgs::Odometry odometry;
      odometry.header.stamp = urban_nav_ros::toRosTime(toStamp(i));
      odometry.pose.pose = urban_nav_ros::toPoseMessage(T_odom_base(i));
      odometry_.publish(odometry);
      if (i > 0) left_.publish(scan(toStamp(i)));
    }
  }
  /// Two rounds through a room with drifting odometry; poses every 100 ms.
  void driveRounds(const urban_nav_core::Trajectory& truth, const urban_nav_core::Trajectory& odometry) {
    tf2_msgs::TFMessage place;
    place.transforms.push_back(
        urban_nav_ros::toStaticTransform("base_link", "laser_right", testing_room::outwardLaser()));
    EXPECT_TRUE(receipts_.await({{"/tf_static", 1}}, [&] { tf_static_.publish(place); }));
    std::mt19937 random(3);
    for (std::size_t i = 0; i < truth.size(); i += 2) {
      nav_msgs::Odometry pose;
      pose.header.stamp = urban_nav_ros::toRosTime(odometry[i].stamp);
      pose.pose.pose = urban_nav_ros::toPoseMessage(odometry[i].pose);
      odometry_.publish(pose);
      if (i == 0) continue;
      urban_nav_core::RelativePose step;
      step.from = odometry[i - 2].stamp;
      step.to = odometry[i].stamp;
      step.T_from_to = odometry[i - 2].pose.inverse() * odometry[i].pose;
      step.covariance = 1e-6 * urban_nav_core::Matrix6d::Identity();
      relative_.publish(urban_nav_ros::toRelativePoseMessage(step, "base_link"));
      ros::WallDuration(0.002).sleep();  // no faster than a connection
      for (const StampNs ahead : {-80'000'000, -40'000'000})
        right_.publish(toMessage(
            testing_room::scanRoom(truth, testing_room::outwardLaser(), truth[i].stamp + ahead, 0.005, random)));
    }
  }
  /// Moves all poses of the graph by dz.
  void lift(std::int64_t revision, double dz) {
    urban_nav_core::GraphUpdate update;
    update.revision = revision;
    update.previous = revision - 1;
    update.segments.emplace_back();
    for (int i = 0; i < kFrames; ++i)
      update.segments.back().poses.push_back(
          {toStamp(i), Pose(Eigen::Matrix3d::Identity(), Vector3d(0.0, 0.0, dz)) * T_odom_base(i)});
    graph_.publish(urban_nav_ros::toGraphUpdateMessage(update, toStamp(kFrames - 1), "map"));
  }
  /// Returns whether the last cloud has over `least` points, all on the wall or on the ground moved by dz.
  bool showsWall(std::size_t least, double dz) const {
    if (clouds.empty() || clouds.back().width * clouds.back().height < least) return false;
    for (sensor_msgs::PointCloud2ConstIterator<float> p(clouds.back(), "x"); p != p.end(); ++p)
      if (std::abs(p[1] - 4.0F) > 0.03F && std::abs(static_cast<double>(p[2]) - dz) > 0.03) return false;
    float low = 1e9F;
    for (sensor_msgs::PointCloud2ConstIterator<float> p(clouds.back(), "x"); p != p.end(); ++p)
      low = std::min(low, p[2]);
    return std::abs(static_cast<double>(low) - dz) < 0.05;
  }

  /// Returns whether the last cloud was rendered with the last pose of drive().
  bool hasLastPose() const {
    return !clouds.empty() && urban_nav_ros::toStampNs(clouds.back().header.stamp) == toStamp(kFrames - 1);
  }

  /// Returns the number of points in the last message of every tile.
  std::size_t pointsOfTiles() const {
    std::map<std::pair<int, int>, std::size_t> last;
    for (const urban_nav_msgs::MapTile& tile : tiles) last[{tile.x, tile.y}] = tile.points.width;
    std::size_t all = 0;
    for (const auto& [tile, points] : last) all += points;
    return all;
  }

  /// Returns the value of a grid at a position; nullopt outside.
  static std::optional<int> valueAt(const nav_msgs::OccupancyGrid& grid, double x, double y) {
    const double cell = grid.info.resolution;
    const auto u = static_cast<std::int64_t>(std::floor((x - grid.info.origin.position.x) / cell));
    const auto v = static_cast<std::int64_t>(std::floor((y - grid.info.origin.position.y) / cell));
    if (u < 0 || v < 0 || u >= grid.info.width || v >= grid.info.height) return std::nullopt;
    return grid.data[static_cast<std::size_t>(v * grid.info.width + u)];
  }
  /// Returns whether the last grid has the wall, free ground before it, and nothing farther away.
  bool hasGridOfWall() const {
    return !grids.empty() && (valueAt(grids.back(), 2.55, 3.95) == 100 || valueAt(grids.back(), 2.55, 4.05) == 100) &&
           valueAt(grids.back(), 2.55, 2.0) == 0 && valueAt(grids.back(), 2.55, 6.0) == -1;
  }

  std::vector<nav_msgs::OccupancyGrid> grids, costs;
  std::vector<sensor_msgs::PointCloud2> terrains;
  std::vector<urban_nav_msgs::MapQuality> qualities;
  std::vector<urban_nav_msgs::RelativeConstraint> constraints;
  std::vector<urban_nav_msgs::MapTile> tiles;
  std::vector<sensor_msgs::PointCloud2> clouds;
  std::vector<urban_nav_msgs::StageStatus> statuses;

 private:
  static sensor_msgs::LaserScan toMessage(const urban_nav_core::Scan& scan) {
    sensor_msgs::LaserScan message;
    message.header.stamp = urban_nav_ros::toRosTime(scan.stamp);
    message.header.frame_id = "laser_right";
    message.angle_min = static_cast<float>(-45.0 * M_PI / 180.0);
    message.angle_increment = static_cast<float>(0.5 * M_PI / 180.0);
    message.angle_max = static_cast<float>(45.0 * M_PI / 180.0);
    message.time_increment = 18.5e-6F;
    message.range_max = 80.0F;
    for (const urban_nav_core::Beam& beam : scan.beams) message.ranges.push_back(beam.range);
    return message;
  }
  static sensor_msgs::LaserScan scan(StampNs stamp) {
    sensor_msgs::LaserScan message;
    message.header.stamp = urban_nav_ros::toRosTime(stamp);
    message.header.frame_id = "laser_left";
    message.angle_min = static_cast<float>(-45.0 * M_PI / 180.0);
    message.angle_max = static_cast<float>(40.0 * M_PI / 180.0);
    message.angle_increment = static_cast<float>(M_PI / 180.0);
    message.range_min = 0.1F;
    message.range_max = 30.0F;
    for (int degrees = -45; degrees <= 40; ++degrees) {
      const double angle = degrees * M_PI / 180.0;
      const double ground = angle < 0.0 ? 1.0 / std::sin(-angle) : std::numeric_limits<double>::infinity();
      message.ranges.push_back(static_cast<float>(std::min(4.0 / std::cos(angle), ground)));
    }
    return message;
  }

  const urban_nav_ros::testing::Receipts receipts_{"laser_mapper"};
  ros::Publisher tf_static_ = advertise<tf2_msgs::TFMessage>("/tf_static", true);
  ros::Publisher odometry_ = advertise<nav_msgs::Odometry>("odometry");
  ros::Publisher relative_ = advertise<urban_nav_msgs::RelativePose>("odometry/relative_pose");
  ros::Publisher left_ = advertise<sensor_msgs::LaserScan>("laser_left/scan");
  ros::Publisher right_ = advertise<sensor_msgs::LaserScan>("laser_right/scan");
  ros::Publisher graph_ = advertise<urban_nav_msgs::GraphUpdate>("graph/update");
};

TEST(LaserMapperNodelet, TheMapGrowsFollowsTheGraphAndIsForgotten) {
  WallRobot robot;
  ASSERT_TRUE(WallRobot::until([&] { return robot.isConnected(); }));
  robot.placeLaser();
  robot.drive();
  // The wall is complete before the last pose, whose cloud may be the next one.
  ASSERT_TRUE(WallRobot::until([&] { return robot.showsWall(1500, 0.0) && robot.hasLastPose(); }))
      << robot.clouds.size() << " clouds";
  EXPECT_EQ(robot.clouds.back().header.frame_id, "map");

  robot.lift(1, 0.5);
  ASSERT_TRUE(WallRobot::until([&] { return robot.showsWall(1500, 0.5); })) << "the graph has moved";

  ASSERT_TRUE(robot.call("reset"));
  robot.diagnostics.clear();  // those of the beginning had no scans either
  ASSERT_TRUE(WallRobot::until([&] { return robot.diagnosed("scans", "0"); }));
  const std::size_t before = robot.clouds.size();
  robot.drive();
  ASSERT_TRUE(WallRobot::until([&] {
    return robot.clouds.size() > before && robot.showsWall(1500, 0.0) && robot.hasLastPose();
  })) << "no pose is left for the next test, which restarts the time";
}

TEST(LaserMapperNodelet, TilesAddUpToTheMapWhichIsSavedAndCleared) {
  WallRobot robot;
  ASSERT_TRUE(WallRobot::until([&] { return robot.isConnected(); }));
  ASSERT_TRUE(robot.call("clear"));
  robot.placeLaser();
  robot.drive();
  ASSERT_TRUE(WallRobot::until([&] {
    return robot.showsWall(1500, 0.0) && robot.pointsOfTiles() == robot.clouds.back().width && !robot.qualities.empty();
  })) << robot.pointsOfTiles()
      << " points in tiles";
  ASSERT_TRUE(WallRobot::until([&] {
    return robot.hasGridOfWall() && !robot.costs.empty() && !robot.terrains.empty();
  })) << robot.grids.size()
      << " grids";
  EXPECT_EQ(robot.grids.back().header.frame_id, "map");
  EXPECT_EQ(robot.costs.back().data.size(), robot.costs.back().info.width * robot.costs.back().info.height);
  EXPECT_GT(robot.terrains.back().width, 20U);
  const urban_nav_msgs::MapTile& tile = robot.tiles.back();
  EXPECT_EQ(tile.header.frame_id, "map");
  EXPECT_NEAR(tile.edge, 25.6, 1e-9) << "256 cubes of 0.1 m";
  EXPECT_GE(tile.revision, 1);
  for (sensor_msgs::PointCloud2ConstIterator<float> p(tile.points, "x"); p != p.end(); ++p) {
    EXPECT_GE(p[0], tile.x * tile.edge - 0.01);
    EXPECT_LE(p[0], (tile.x + 1) * tile.edge + 0.01);
  }
  EXPECT_EQ(robot.qualities.back().wall_pairs, 0U) << "a single pass";

  urban_nav_msgs::FileCommand save;
  save.request.path = ::testing::TempDir() + "laser_mapper_nodelet_test.ply";
  ASSERT_TRUE(ros::service::call("laser_mapper/save", save) && save.response.success) << save.response.message;
  std::ifstream file(save.request.path);
  std::string line;
  ASSERT_TRUE(std::getline(file, line));
  EXPECT_EQ(line, "ply");
  std::remove(save.request.path.c_str());
  save.request.path = "/no/such/folder/map.ply";
  ASSERT_TRUE(ros::service::call("laser_mapper/save", save));
  EXPECT_FALSE(save.response.success);
  EXPECT_NE(save.response.message.find("/no/such/folder"), std::string::npos) << save.response.message;

  ASSERT_TRUE(robot.call("clear"));
  ASSERT_TRUE(WallRobot::until([&] { return robot.pointsOfTiles() == 0; })) << "tiles are emptied";
}

TEST(LaserMapperNodelet, ASilentOdometryIsNamed) {
  WallRobot robot;
  ASSERT_TRUE(WallRobot::until([&] { return robot.isConnected(); }));
  ASSERT_TRUE(
      WallRobot::until([&] { return !robot.statuses.empty() && robot.statuses.back().reason_name == "NoOdometry"; }));
  EXPECT_EQ(robot.statuses.back().status, urban_nav_msgs::StageStatus::DEGRADED);
  EXPECT_NE(robot.statuses.back().message.find("/odometry"), std::string::npos) << robot.statuses.back().message;
}

TEST(LaserMapperNodelet, PlanesOfTwoRoundsConstrainThePosesOfTheGraph) {
  WallRobot robot;
  ASSERT_TRUE(WallRobot::until([&] { return robot.isConnected(); }));
  ASSERT_TRUE(robot.call("clear"));
  const urban_nav_core::Trajectory truth = testing_room::driveRounds();
  const urban_nav_core::Trajectory drifting = testing_room::driftFrom(truth, 0.1);
  robot.driveRounds(truth, drifting);
  for (int i = 0; i < 5 && robot.constraints.size() < 3; ++i)  // clouds are rendered in the meantime
    WallRobot::until([&] { return robot.constraints.size() > 2; });
  ASSERT_GT(robot.constraints.size(), 2U);
  double before = 0.0, after = 0.0;
  for (const urban_nav_msgs::RelativeConstraint& message : robot.constraints) {
    const auto constraint = urban_nav_ros::toRelativeConstraint(message);
    ASSERT_TRUE(constraint);
    EXPECT_EQ(constraint->kind, "plane");
    EXPECT_EQ(constraint->source, "laser_mapper");
    const std::size_t a = truth.nearest(constraint->a.stamp), b = truth.nearest(constraint->b.stamp);
    EXPECT_EQ(truth[a].stamp, constraint->a.stamp);
    EXPECT_EQ(truth[b].stamp, constraint->b.stamp);
    const auto squared = [&](const Pose& T_a_b) {
      const urban_nav_core::Vector6d error = urban_nav_core::boxMinus(T_a_b, truth[a].pose.inverse() * truth[b].pose);
      return error.dot(constraint->measured.information * error);
    };
    after += squared(constraint->measured.T_a_b);
    before += squared(drifting[a].pose.inverse() * drifting[b].pose);
  }
  EXPECT_LT(after, 0.2 * before);
}

}  // namespace
}  // namespace laser_mapper

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "laser_mapper_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
