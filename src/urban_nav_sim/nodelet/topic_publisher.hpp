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

/// Publishers of the simulator: all topics of some sensors, /tf_static, and /clock with use_sim_time. Used only by the
/// worker. Does not publish /tf, which is the output of odometry; the true pose is available as tf on ground_truth/tf,
/// for rviz.
class TopicPublisher {
 public:
  /// Advertises all topics, so that subscribers can connect before the first message. `queue`: queue size per
  /// subscriber.
  TopicPublisher(ros::NodeHandle& nh, const std::set<Sensor>& sensors, std::uint32_t queue);

  bool keepsTime() const { return clock_; }
  /// Latched.
  void publish(const std::vector<geometry_msgs::TransformStamped>& transforms);
  /// The message is shared with nodelets of the same process: it must not be modified afterwards. The true pose goes to
  /// ground_truth/tf as well.
  void publish(const TopicMessage& message);
  /// Advances /clock to `now`, in steps of at least 5 ms, or resets it at the begin of a session.
  void advance(urban_nav_core::StampNs now);
  /// Publishes /clock again, for new subscribers while time stops.
  void repeatClock();

 private:
  std::map<std::string, ros::Publisher> publishers_;
  ros::Publisher static_, truth_, clock_;
  std::optional<urban_nav_core::StampNs> now_;
};

}  // namespace urban_nav_sim
