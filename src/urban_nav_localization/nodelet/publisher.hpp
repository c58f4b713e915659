// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <optional>
#include <vector>

#include "live/nodelet_parameters.hpp"
#include "urban_nav_localization/localiser.hpp"
#include "urban_nav_ros/map_from_odom.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav_localization {

/// Topics of the localization, and the transform map -> odom. Thread-safe.
class LocalizationPublisher {
 public:
  LocalizationPublisher(ros::NodeHandle& nh, const NodeletParameters& parameters);

  /// Publishes localization/map_path: the sessions of the map one after another.
  void publish(const std::vector<urban_nav_store::StoredTrajectory>& map);
  /// Publishes localization/state, and localization/pose while Localized, else localization/hypothesis if there is one.
  /// Sets what sendTransform() sends.
  void publish(const LocalizationEstimate& estimate, const std::optional<urban_nav_core::Pose>& T_map_odom);
  /// Sends map -> odom, as soon as it is known, with the stamp of a message of odometry.
  void sendTransform(urban_nav_core::StampNs stamp);

 private:
  const NodeletParameters parameters_;
  ros::Publisher state_, pose_, hypothesis_, map_path_;
  urban_nav_ros::MapFromOdom map_from_odom_;
};

}  // namespace urban_nav_localization
