// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "urban_nav_sim/ros/measurement_messages.hpp"

namespace urban_nav_sim {

/// The simulator's side of the graph: all topics of some sensors, /tf_static, and /clock if the graph keeps simulated
/// time. Used by the worker alone. No /tf: where the robot is in the world, its odometry has to find out. Who is to see
/// the truth as tf (rviz) hears ground_truth/tf in its place.
class TopicPublisher {
 public:
  /// Advertises all of them, so that subscribers may connect before the first message. `queue`: messages that may wait
  /// for a subscriber.
  TopicPublisher(ros::NodeHandle& nh, const std::set<Sensor>& sensors, std::uint32_t queue);

  bool keepsTime() const { return clock_; }
  /// Latched.
  void publish(const std::vector<geometry_msgs::TransformStamped>& transforms);
  /// The message is shared with nodelets of the same process: it must not be modified afterwards. The true pose goes to
  /// ground_truth/tf as well.
  void publish(const TopicMessage& message);
  /// Advances /clock to `now`, in steps of 5 ms at least; or back, where a session begins.
  void advance(urban_nav_core::StampNs now);
  /// /clock once more, for those who came while it stood.
  void repeatClock();

 private:
  std::map<std::string, ros::Publisher> publishers_;
  ros::Publisher static_, truth_, clock_;
  std::optional<urban_nav_core::StampNs> now_;
};

}  // namespace urban_nav_sim
