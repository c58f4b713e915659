// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "loop_metric/local_cloud.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace loop_metric {

/// The scans of the last minute, of any number of lasers: as much as a local cloud may need. At most 10 000 a laser, some 30 MB. Used by one thread.
class RecentScans {
 public:
  /// `transforms` must outlive it.
  RecentScans(std::string base_frame, const urban_nav_ros::StaticTransforms& transforms)
      : base_frame_(std::move(base_frame)), transforms_(transforms) {}

  /// False, and left out, where the message is damaged. Where stamps go back by more than a second, those before are forgotten.
  bool add(const sensor_msgs::LaserScan& message);
  /// Those whose place on the robot is known by now. For as long as nothing is added.
  std::vector<LaserScans> lasers() const;
  /// The first laser without a place; empty: all have one.
  std::string unplaced() const;

 private:
  using Scans = std::deque<urban_nav_core::Scan>;  // in order of time
  const std::string base_frame_;
  const urban_nav_ros::StaticTransforms& transforms_;
  std::map<std::string, Scans> scans_;  // by frame
};

}  // namespace loop_metric
