// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <urban_nav_msgs/StageStatus.h>

#include <mutex>
#include <optional>
#include <vector>

#include "loop_metric/localiser.hpp"
#include "nodelet_parameters.hpp"
#include "urban_nav_core/types/status.hpp"
#include "urban_nav_ros/map_from_odom.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace loop_metric {

/// What is wrong with localisation as a whole; that the robot is not KNOWN is no fault. Numbers are part of the messages: new ones go to the end.
enum class LocaliseTrouble {
  None = 0,
  NoOdometry = 1,  ///< it has not come, or is silent
  NoMap = 2,       ///< the map holds no views of this camera, or is damaged
  NoCamera = 3,    ///< the two camera_info make no stereo camera
  NoImages = 4,    ///< there is nothing to look for in the map
  ReadingMap = 5,  ///< its views are being read
};
/// "None", "NoOdometry", ...
const char* toString(LocaliseTrouble trouble);

/// Topics of localisation, and map -> odom. Thread-safe.
class LocalisePublisher {
 public:
  LocalisePublisher(ros::NodeHandle& nh, const LocalisationParameters& parameters);

  /// localisation/map, once: the sessions of the map one behind the other.
  void publish(const std::vector<urban_nav_store::StoredTrajectory>& map);
  /// localisation/state; localisation/pose where the robot is KNOWN, localisation/guess where there is but a guess; and map -> odom.
  void publish(const Located& located, const std::optional<urban_nav_core::Pose>& T_map_odom);
  /// map -> odom for a message of odometry, as soon as it is known.
  void sendTransform(urban_nav_core::StampNs stamp);
  /// Where it is another one than the last.
  void publish(const urban_nav_core::Status& status);

 private:
  const LocalisationParameters parameters_;
  ros::Publisher state_, pose_, guess_, map_, status_;
  urban_nav_ros::MapFromOdom map_from_odom_;
  std::mutex mutex_;  // guards what follows
  urban_nav_msgs::StageStatus last_;
};

}  // namespace loop_metric
