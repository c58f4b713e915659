// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>
#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/GraphState.h>
#include <urban_nav_msgs/GraphUpdate.h>
#include <urban_nav_msgs/GroundPlane.h>
#include <urban_nav_msgs/MetricClosure.h>
#include <urban_nav_msgs/PoseCorrection.h>
#include <urban_nav_msgs/RelativeConstraint.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/StageStatus.h>
#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "urban_nav_ros/testing/listener.hpp"
#include "urban_nav_ros/testing/receipts.hpp"

namespace pose_graph::test {

/// The ROS graph around the nodelet: publishers of other stages, and a listener that keeps all messages.
class Listener : public urban_nav_ros::testing::Listener {
 public:
  Listener() : urban_nav_ros::testing::Listener("pose_graph") {
    keep("graph/update", updates);
    keep("graph/correction", corrections);
    keep("graph/path", paths);
    keep("graph/state", states);
    keep("graph/markers", markers);
    keep("pose_graph/status", statuses);
    keep("/tf", transforms);
    connected_ = until([this] { return isConnected(); });
  }
  bool connected() const { return connected_; }

  /// Discards what the nodelet has published so far, after its arrival. States and paths have queues of one message,
  /// which receipts do not cover.
  void forgetAll() {
    EXPECT_TRUE(receipts.drain({"graph/update", "graph/correction"}));
    do {
      forget();
      ros::WallDuration(0.2).sleep();
      ros::spinOnce();
    } while (!states.empty() || !paths.empty());
  }
  void forget() {
    ros::spinOnce();
    updates.clear();
    corrections.clear();
    paths.clear();
    states.clear();
    markers.clear();
    transforms.clear();
    diagnostics.clear();
  }

  const urban_nav_ros::testing::Receipts receipts{"pose_graph"};
  ros::Publisher relative = advertise<urban_nav_msgs::RelativePose>("odometry/relative_pose");
  ros::Publisher odometry = advertise<nav_msgs::Odometry>("odometry");
  ros::Publisher closures = advertise<urban_nav_msgs::MetricClosure>("loops/metric");
  ros::Publisher constraints = advertise<urban_nav_msgs::RelativeConstraint>("map/constraints");
  ros::Publisher fixes = advertise<sensor_msgs::NavSatFix>("gps/fix");
  ros::Publisher imu = advertise<sensor_msgs::Imu>("imu/data");
  ros::Publisher ground = advertise<urban_nav_msgs::GroundPlane>("stereo/ground_plane");
  std::vector<urban_nav_msgs::GraphUpdate> updates;
  std::vector<urban_nav_msgs::PoseCorrection> corrections;
  std::vector<nav_msgs::Path> paths;
  std::vector<urban_nav_msgs::GraphState> states;
  std::vector<visualization_msgs::MarkerArray> markers;
  std::vector<urban_nav_msgs::StageStatus> statuses;
  std::vector<tf2_msgs::TFMessage> transforms;

 private:
  bool connected_ = false;
};

}  // namespace pose_graph::test
