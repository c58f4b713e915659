// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/LaserOdometryStatus.h>
#include <urban_nav_msgs/RelativePose.h>

#include <cstring>

#include "../support/floor_plans.hpp"
#include "laser_odometry/motion_aided_odometry.hpp"
#include "urban_nav_core/laser/planar_sweep.hpp"
#include "urban_nav_core/sequence/sweep_motion_queue.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/motion.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/listener.hpp"
#include "urban_nav_ros/testing/receipts.hpp"

namespace laser_odometry::test {
namespace {

/// A sweep as published by Velodyne's driver: the header has the time of the last point.
sensor_msgs::PointCloud2 toVelodyneCloud(const Sweep& sweep) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = urban_nav_ros::toRosTime(sweep.reference + 50'000'000);
  cloud.header.frame_id = "velodyne";
  const auto add = [&cloud](const char* name, std::uint32_t offset, std::uint8_t datatype) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = offset;
    field.datatype = datatype;
    field.count = 1;
    cloud.fields.push_back(field);
  };
  using sensor_msgs::PointField;
  add("x", 0, PointField::FLOAT32);
  add("y", 4, PointField::FLOAT32);
  add("z", 8, PointField::FLOAT32);
  add("intensity", 12, PointField::FLOAT32);
  add("ring", 16, PointField::UINT16);
  add("time", 18, PointField::FLOAT32);
  cloud.point_step = 22;
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(sweep.beams.size());
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(cloud.row_step);
  std::uint8_t* at = cloud.data.data();
  for (const urban_nav_core::Beam& beam : sweep.beams) {
    const Eigen::Vector3f p = beam.range * beam.direction;
    const float intensity = 10.0F;
    const auto time = static_cast<float>(urban_nav_core::secondsBetween(sweep.reference, beam.stamp) - 0.05);
    std::memcpy(at, p.data(), 12);
    std::memcpy(at + 12, &intensity, 4);
    std::memcpy(at + 16, &beam.ring, 2);
    std::memcpy(at + 18, &time, 4);
    at += 22;
  }
  return cloud;
}

/// A robot that publishes, and a listener that records everything.
class LaserGraph : public urban_nav_ros::testing::Listener {
 public:
  LaserGraph() : Listener("laser_odometry"), receipts_("laser_odometry") {
    keep("lo/odometry", odometry);
    keep("lo/relative_pose", relative);
    keep("lo/status", statuses);
    keep("lo/local_map", maps);
    keep("/tf", transforms);
  }
  void place(const Pose& T_base_lidar) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(
        urban_nav_ros::toStaticTransform(urban_nav_core::frames::kBaseLink, "velodyne", T_base_lidar));
    EXPECT_TRUE(receipts_.await({{"/tf_static", 1}}, [&] { tf_static_.publish(message); }));
  }
  void show(const Sweep& sweep) {
    EXPECT_TRUE(receipts_.await({{"points", 1}}, [&] { points_.publish(toVelodyneCloud(sweep)); }));
  }

  std::vector<nav_msgs::Odometry> odometry;
  std::vector<urban_nav_msgs::RelativePose> relative;
  std::vector<urban_nav_msgs::LaserOdometryStatus> statuses;
  std::vector<sensor_msgs::PointCloud2> maps;
  std::vector<tf2_msgs::TFMessage> transforms;

 private:
  const urban_nav_ros::testing::Receipts receipts_;
  ros::Publisher points_ = advertise<sensor_msgs::PointCloud2>("points");
  ros::Publisher tf_static_ = advertise<tf2_msgs::TFMessage>("/tf_static", true);
};

/// The scan of a planar laser as published by its driver: the header has the time of the first beam.
sensor_msgs::LaserScan toScanMessage(const Sweep& sweep, const std::string& frame) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = urban_nav_ros::toRosTime(sweep.reference - 50'000'000);
  scan.header.frame_id = frame;
  constexpr std::size_t kBeams = 720;
  scan.angle_increment = static_cast<float>(-2.0 * M_PI / kBeams);
  scan.angle_min = static_cast<float>(M_PI * (1.0 - 1.0 / kBeams));
  scan.angle_max = -scan.angle_min;
  scan.time_increment = 0.1F / kBeams;
  scan.scan_time = 0.1F;
  scan.range_min = 0.1F;
  scan.range_max = 40.0F;
  scan.ranges.assign(kBeams, HUGE_VALF);
  for (const urban_nav_core::Beam& beam : sweep.beams) scan.ranges[beam.column] = beam.range;
  return scan;
}

/// The same robot with a planar laser, in a namespace of its own: "aided" has wheels.
class PlanarGraph : public urban_nav_ros::testing::Listener {
 public:
  explicit PlanarGraph(const std::string& ns = "planar")
      : Listener(ns + "/laser_odometry"), ns_(ns), receipts_(ns + "/laser_odometry") {
    keep(ns + "/lo/odometry", odometry);
    keep(ns + "/lo/status", statuses);
  }
  void place(const std::string& frame, const Pose& T_base_laser) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(
        urban_nav_ros::toStaticTransform(urban_nav_core::frames::kBaseLink, frame, T_base_laser));
    EXPECT_TRUE(receipts_.await({{"/tf_static", 1}}, [&] { tf_static_.publish(message); }));
  }
  void show(const Sweep& sweep, const std::string& frame) {
    EXPECT_TRUE(receipts_.await({{ns_ + "/scan", 1}}, [&] { scans_.publish(toScanMessage(sweep, frame)); }));
  }
  void roll(const nav_msgs::Odometry& message) {
    EXPECT_TRUE(receipts_.await({{ns_ + "/wheel_odom", 1}}, [&] { wheels_.publish(message); }));
  }
  bool isNamed(const std::string& fault) const {
    for (const auto& array : diagnostics)
      for (const auto& status : array.status)
        if (status.message.find(fault) != std::string::npos) return true;
    return false;
  }

  std::vector<nav_msgs::Odometry> odometry;
  std::vector<urban_nav_msgs::LaserOdometryStatus> statuses;

 private:
  const std::string ns_;
  const urban_nav_ros::testing::Receipts receipts_;
  ros::Publisher scans_ = advertise<sensor_msgs::LaserScan>(ns_ + "/scan");
  ros::Publisher wheels_ = ns_ == "aided" ? advertise<nav_msgs::Odometry>(ns_ + "/wheel_odom") : ros::Publisher();
  ros::Publisher tf_static_ = advertise<tf2_msgs::TFMessage>("/tf_static", true);
};

TEST(LaserOdometryNodelet, FollowsTheScansOfAHorizontalPlanarLaserAndRefusesAVerticalOne) {
  PlanarGraph graph;
  ASSERT_TRUE(PlanarGraph::until([&] { return graph.isConnected(); }));
  const SpinningLidar laser = makePlanarLaser();
  const BoxWorld world = makeOffice(1);
  const auto motion = makeFigureEight(4.0, 1.5, 40.0);
  graph.place("vertical", Pose(urban_nav_core::expSo3({M_PI / 2.0, 0.0, 0.0}), {0.0, 0.2, 0.5}));
  graph.show(laser.scan(world, motion, 0.0, 1), "vertical");
  EXPECT_TRUE(PlanarGraph::until([&] { return graph.isNamed("vertical is tilted by 90 deg against base_link"); }));

  graph.place("laser", laser.T_base_lidar);
  constexpr int kScans = 16;
  for (int i = 1; i <= kScans; ++i) graph.show(laser.scan(world, motion, 0.1 * i, 1), "laser");
  ASSERT_TRUE(PlanarGraph::until([&] { return graph.odometry.size() == kScans; })) << graph.odometry.size();
  const auto last = urban_nav_ros::toPose(graph.odometry.back().pose.pose);
  ASSERT_TRUE(last);
  EXPECT_LT(distanceBetween(*last, motion(0.1).inverse() * motion(0.1 * kScans)), 0.02);
  EXPECT_EQ(graph.odometry.back().pose.pose.position.z, 0.0);
  EXPECT_GT(graph.odometry.back().pose.covariance[14], 1e-7);  // of the height, which is assumed
  ASSERT_TRUE(PlanarGraph::until([&] { return graph.statuses.size() == kScans; }));
  EXPECT_EQ(graph.statuses.back().status, urban_nav_msgs::LaserOdometryStatus::OK) << graph.statuses.back().message;
  EXPECT_EQ(graph.statuses.back().reason_name, "planar");
  EXPECT_TRUE(graph.statuses.back().deskewed);
}

nav_msgs::Odometry toWheelMessage(double seconds, const Pose& T_odom_base) {
  nav_msgs::Odometry message;
  message.header.stamp = urban_nav_ros::toRosTime(SpinningLidar::toStamp(seconds));
  message.pose.pose = urban_nav_ros::toPoseMessage(T_odom_base);
  return message;
}

/// Poses of the core for these scans and wheels, by the order of their stamps.
std::vector<Pose> offlinePoses(const std::vector<Sweep>& sweeps, const std::vector<nav_msgs::Odometry>& wheels,
                               const Pose& T_base_laser) {
  urban_nav_core::SweepMotionQueue<Sweep>::Options options;
  options.max_lateness = 200'000'000;
  options.motion = urban_nav_core::toMotionChoice("wheels");
  urban_nav_core::SweepMotionQueue<Sweep> queue(options);
  urban_nav_core::PlanarSweepReader reader;
  for (const Sweep& each : sweeps) {
    const Sweep sweep = reader.read(*urban_nav_ros::toPlanarScan(toScanMessage(each, "laser"), {}));
    queue.add(sweep.beams.back().stamp, sweep);
  }
  urban_nav_ros::WheelMotion motion(0.05);
  for (const nav_msgs::Odometry& message : wheels)
    if (const auto input = motion.add(message)) queue.add(*input);
  queue.finish();
  MotionAidedOdometry odometry({}, T_base_laser, Scanner::Planar);
  std::vector<Pose> poses;
  while (const auto ready = queue.take()) poses.push_back(odometry.process(ready->sweep, ready->inputs).T_odom_base);
  return poses;
}

TEST(LaserOdometryNodelet, WheelsCarryTheMotionAlongACorridorAsOffline) {
  PlanarGraph graph("aided");
  ASSERT_TRUE(PlanarGraph::until([&] { return graph.isConnected(); }));
  const SpinningLidar laser = makePlanarLaser();
  const BoxWorld world = makeCorridor();
  const auto motion = [](double t) { return Pose(Eigen::Quaterniond::Identity(), {t + 0.3 * std::sin(t), 0.0, 0.0}); };
  graph.place("laser", laser.T_base_lidar);
  constexpr int kScans = 30;
  std::vector<Sweep> sweeps;
  std::vector<nav_msgs::Odometry> wheels;
  for (int i = 1; i <= kScans; ++i) {
    sweeps.push_back(laser.scan(world, motion, 0.1 * i, 1));
    graph.show(sweeps.back(), "laser");
    // The messages of the wheels arrive after the scan that they follow.
    for (int k = 0; k < 5; ++k) {
      const double t = 0.1 * i - 0.04 + 0.02 * k;
      wheels.push_back(toWheelMessage(t, motion(t)));
      graph.roll(wheels.back());
    }
  }
  EXPECT_TRUE(graph.call("finish"));
  ASSERT_TRUE(PlanarGraph::until([&] { return graph.odometry.size() == kScans; })) << graph.odometry.size();
  const auto last = urban_nav_ros::toPose(graph.odometry.back().pose.pose);
  ASSERT_TRUE(last);
  const Pose truth = motion(0.1).inverse() * motion(0.1 * kScans);
  EXPECT_GT(truth.t().x(), 2.5);
  EXPECT_LT(distanceBetween(*last, truth), 0.05);
  ASSERT_TRUE(PlanarGraph::until([&] { return graph.statuses.size() == kScans; }));
  EXPECT_EQ(graph.statuses.back().status, urban_nav_msgs::LaserOdometryStatus::DEGRADED);
  const std::vector<Pose> expected = offlinePoses(sweeps, wheels, laser.T_base_lidar);
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(kScans));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(graph.odometry[i].pose.pose.position.x, expected[i].t().x()) << i;
    EXPECT_EQ(graph.odometry[i].pose.pose.position.y, expected[i].t().y()) << i;
    EXPECT_EQ(graph.odometry[i].pose.pose.orientation.z, expected[i].q().z()) << i;
  }
}

TEST(LaserOdometryNodelet, FollowsADriveAndReportsFaults) {
  LaserGraph graph;
  ASSERT_TRUE(LaserGraph::until([&] { return graph.isConnected(); }));
  const Pose T_base_lidar(urban_nav_core::expSo3({0.0, 0.0, 0.5}), {0.3, 0.0, 0.2});
  const BoxWorld world = makeRoom();
  SpinningLidar lidar;
  lidar.T_base_lidar = T_base_lidar;
  const auto motion = makeDrive(0.8, 0.2);

  graph.show(lidar.scan(world, motion, 0.0, 1));  // before the pose of the LiDAR is known
  const auto named = [&] {
    for (const auto& array : graph.diagnostics)
      for (const auto& status : array.status)
        if (status.message.find("no transform from base_link to velodyne") != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(LaserGraph::until(named));

  graph.place(T_base_lidar);
  constexpr int kSweeps = 16;
  for (int i = 1; i <= kSweeps; ++i) graph.show(lidar.scan(world, motion, 0.1 * i, 1));
  ASSERT_TRUE(LaserGraph::until([&] { return graph.odometry.size() == kSweeps && graph.statuses.size() == kSweeps; }))
      << graph.odometry.size();
  EXPECT_EQ(graph.relative.size(), static_cast<std::size_t>(kSweeps) - 1);
  EXPECT_EQ(graph.odometry.back().header.frame_id, "odom");
  EXPECT_EQ(graph.odometry.back().child_frame_id, "base_link");
  const auto last = urban_nav_ros::toPose(graph.odometry.back().pose.pose);
  ASSERT_TRUE(last);
  const Pose truth = motion(0.1).inverse() * motion(0.1 * kSweeps);
  EXPECT_LT(distanceBetween(*last, truth), 0.02);
  EXPECT_NEAR(graph.odometry.back().twist.twist.linear.x, 0.8, 0.1);
  EXPECT_GT(graph.odometry.back().pose.covariance[0], 0.0);
  EXPECT_EQ(graph.statuses.back().status, urban_nav_msgs::LaserOdometryStatus::OK) << graph.statuses.back().message;
  EXPECT_TRUE(graph.statuses.back().deskewed);
  EXPECT_TRUE(LaserGraph::until([&] { return !graph.maps.empty() && graph.maps.back().width > 100; }));
  EXPECT_TRUE(LaserGraph::until([&] { return !graph.transforms.empty(); }));

  EXPECT_TRUE(graph.call("reset"));
  graph.show(lidar.scan(world, motion, 3.0, 1));
  ASSERT_TRUE(LaserGraph::until([&] { return graph.odometry.size() == kSweeps + 1; }));
  EXPECT_EQ(graph.odometry.back().pose.pose.position.x, 0.0);
}

}  // namespace
}  // namespace laser_odometry::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "laser_odometry_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
