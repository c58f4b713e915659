// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/GraphState.h>
#include <urban_nav_msgs/GraphUpdate.h>
#include <urban_nav_msgs/MapJump.h>
#include <urban_nav_msgs/MetricClosure.h>
#include <urban_nav_msgs/RelativeConstraint.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/StageStatus.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace pose_graph::test {

/// The ROS graph as the nodelet sees it: stages that publish, and a listener who keeps everything.
class Listener {
 public:
  Listener() {
    relative = nh_.advertise<urban_nav_msgs::RelativePose>("vo/relative_pose", 1000);
    odometry = nh_.advertise<nav_msgs::Odometry>("vo/odometry", 1000);
    closures = nh_.advertise<urban_nav_msgs::MetricClosure>("loops/metric", 1000);
    constraints = nh_.advertise<urban_nav_msgs::RelativeConstraint>("map/constraints", 1000);
    keep("graph/update", updates);
    keep("graph/jump", jumps);
    keep("graph/path", paths);
    keep("graph/state", states);
    keep("graph/markers", markers);
    keep("pose_graph/status", statuses);
    keep("/tf", transforms);
    keep("/diagnostics", diagnostics);
    connected_ = until([this] {
      return relative.getNumSubscribers() > 0 && odometry.getNumSubscribers() > 0 && closures.getNumSubscribers() > 0 &&
             constraints.getNumSubscribers() > 0 && hearsAll();
    });
  }
  bool connected() const { return connected_; }
  /// All that the nodelet publishes has come through to here.
  bool hearsAll() const {
    return std::all_of(subscribers_.begin(), subscribers_.end(),
                       [](const ros::Subscriber& each) { return each.getNumPublishers() > 0; });
  }

  bool call(const std::string& service) {
    std_srvs::Trigger trigger;
    return ros::service::call("pose_graph/" + service, trigger) && trigger.response.success;
  }

  /// Spins until it is so; false after ten seconds.
  static bool until(const std::function<bool()>& so) {
    for (int i = 0; i < 1000 && ros::ok(); ++i) {
      ros::spinOnce();
      if (so()) return true;
      ros::WallDuration(0.01).sleep();
    }
    return false;
  }

  void forget() {
    ros::spinOnce();
    updates.clear();
    jumps.clear();
    paths.clear();
    states.clear();
    markers.clear();
    transforms.clear();
    diagnostics.clear();
  }

  ros::Publisher relative, odometry, closures, constraints;
  std::vector<urban_nav_msgs::GraphUpdate> updates;
  std::vector<urban_nav_msgs::MapJump> jumps;
  std::vector<nav_msgs::Path> paths;
  std::vector<urban_nav_msgs::GraphState> states;
  std::vector<visualization_msgs::MarkerArray> markers;
  std::vector<urban_nav_msgs::StageStatus> statuses;
  std::vector<tf2_msgs::TFMessage> transforms;
  std::vector<diagnostic_msgs::DiagnosticArray> diagnostics;

 private:
  template <typename Message>
  void keep(const std::string& topic, std::vector<Message>& into) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [&into](const boost::shared_ptr<const Message>& message) { into.push_back(*message); };
    subscribers_.push_back(nh_.subscribe<Message>(topic, 1000, callback));
  }

  ros::NodeHandle nh_;
  std::vector<ros::Subscriber> subscribers_;
  bool connected_ = false;
};

}  // namespace pose_graph::test
