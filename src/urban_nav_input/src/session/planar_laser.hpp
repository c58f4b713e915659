// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/laser/planar_sweep.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/planar_clouds.hpp"
#include "urban_nav_input/session/source.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// A planar laser of a recording with its mounting.
struct PlacedLaser {
  std::string role, topic, frame;
  urban_nav_core::Pose T_base_laser;
};

/// The planar lasers of a recording.
struct PlacedLasers {
  std::vector<PlacedLaser> lasers;  ///< those with a mounting
  std::vector<std::string> notes;   ///< on the others, and on assumptions

  /// Finds the mountings of the lasers with scans. `assumes_base`: without tf, a laser of the role `laser0` is
  /// assumed to be horizontal, at base_link.
  static PlacedLasers find(Recording& recording, const BagTopics& topics, PlanarClouds& clouds,
                           const urban_nav_ros::StaticTransforms& transforms, bool assumes_base);
};

/// Returns whether a topic has the role of a planar laser.
bool hasLaser(const BagTopics& topics);

/// Returns a finding for each tilted laser of the roles laser0, laser1, ... that could be laser_left or laser_right by
/// its mounting, where that role is free.
std::vector<Finding> sideFindings(const PlacedLasers& placed, BagTopics topics);

/// The horizontal planar laser whose scans are read as sweeps. Not thread-safe.
class PlanarLaser {
 public:
  /// Returns the first horizontal laser of the roles laser0, laser1, ..., else the first horizontal one; nullopt
  /// without one.
  static std::optional<PlanarLaser> choose(const PlacedLasers& placed);
  /// Returns why a recording with nothing but these lasers, none of which is horizontal, has no odometry. `clouds`:
  /// findings on lasers that publish clouds.
  static std::string describeFailure(const PlacedLasers& placed, const std::vector<Finding>& clouds);

  const std::string& role() const { return laser_.role; }
  const std::string& topic() const { return laser_.topic; }
  std::string note() const;
  SweepInput read(const urban_nav_core::PlanarScan& scan);
  void archive(urban_nav_core::Archive& archive);

 private:
  PlacedLaser laser_;
  urban_nav_core::PlanarSweepReader reader_;
};

}  // namespace urban_nav_input
