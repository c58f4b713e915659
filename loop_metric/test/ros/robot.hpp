// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Image.h>
#include <urban_nav_msgs/MetricClosure.h>
#include <urban_nav_msgs/StageStatus.h>
#include <urban_nav_msgs/TopologicalClosure.h>

#include <utility>
#include <vector>

#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/testing/driving_robot.hpp"

namespace loop_metric::test {

using namespace urban_nav_ros::testing;

/// A robot with odometry and place recognition, and a listener to the verdicts of the nodelet.
class Robot : public DrivingRobot {
 public:
  explicit Robot(urban_nav_core::testing::RenderedSequence sequence = room())
      : DrivingRobot("loop_metric", std::move(sequence)) {
    keep("loops/metric", closures);
    keep("loops/matches", pictures);
    keep("loop_metric/status", statuses);
    listening_ = until([this] { return isConnected(); });
  }
  bool connected() const { return listening_; }

  void recognise(const urban_nav_core::PoseRef& a, const urban_nav_core::PoseRef& b) {
    places_.publish(urban_nav_ros::toTopologicalClosureMessage({a, b, 0.99}));
  }
  void recognise(int a, int b) { recognise({"", toStamp(a)}, {"", toStamp(b)}); }
  /// Waits for the next verdict.
  bool judged(std::size_t count) {
    return until([&] { return closures.size() >= count; });
  }
  void forget() {
    ros::spinOnce();
    closures.clear();
    pictures.clear();
    diagnostics.clear();
  }

  std::vector<urban_nav_msgs::MetricClosure> closures;
  std::vector<sensor_msgs::Image> pictures;
  std::vector<urban_nav_msgs::StageStatus> statuses;

 private:
  ros::Publisher places_ = advertise<urban_nav_msgs::TopologicalClosure>("places/closure");
  bool listening_ = false;
};

}  // namespace loop_metric::test
