// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/trajectory/travel_spacing.hpp"
#include "urban_nav_registration/cloud/local_cloud.hpp"

namespace urban_nav_localization {

/// Sweeps of 3D LiDARs of the last metres, for local clouds: those that a store would hold of this drive, as it would
/// hold them. Not thread-safe.
class RecentSweeps {
 public:
  /// Adds a sweep, if the motion of the robot requires it (kSweepSpacing). Sweeps from before a jump back in time are
  /// dropped. `T_odom_base`: newest pose of odometry.
  void add(const std::string& frame, const urban_nav_core::Sweep& sweep,
           const std::optional<urban_nav_core::Pose>& T_odom_base);
  /// Sets the pose of a LiDAR. Ignored for other frames.
  void setLidar(const std::string& frame, const urban_nav_core::Pose& T_base_lidar);

  bool any() const { return !lidars_.empty(); }
  /// Returns the LiDARs whose pose is known, each ring of a sweep as a scan. Valid until the next add().
  std::vector<urban_nav_registration::LaserScans> lidars() const;
  /// Returns the frames of LiDARs without a pose.
  std::vector<std::string> unplaced() const;

 private:
  struct Lidar {
    std::optional<urban_nav_core::Pose> T_base_lidar;
    urban_nav_core::TravelSpacing spacing{urban_nav_core::kSweepSpacing};
    std::deque<std::pair<urban_nav_core::StampNs, std::string>> sweeps;  // packed by LidarSweep, in order of time
  };
  std::map<std::string, Lidar> lidars_;  // by frame
};

}  // namespace urban_nav_localization
