// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <string>

#include "fabmap_node/fab_map.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace fabmap_node {

/// Recent beliefs at their odometry poses, for display. Memory is bounded. Not thread-safe.
class BeliefTrail {
 public:
  struct Point {
    urban_nav_core::StampNs stamp = 0;
    Eigen::Vector3d p_odom = Eigen::Vector3d::Zero();  ///< m
    PlaceKnowledge knowledge = PlaceKnowledge::New;
    double p_new = 1.0;
    std::optional<LikelyPlace> likeliest;  ///< of its places
  };

  /// Adds a pose of odometry. A backward jump of stamps begins a new path.
  void addOdometry(const urban_nav_core::StampedPose& T_odom_base);
  /// Adds a belief once odometry has reached its stamp, except for unused observations and stationary robots. A
  /// backward jump of stamps clears the trail.
  void add(const PlaceBelief& belief);
  /// Replaces the belief with the stamp of this one, if there is one.
  void revise(const PlaceBelief& belief);
  void clear();

  /// Returns the beliefs in order of time.
  const std::deque<Point>& points() const { return points_; }
  /// Returns the point of the observation with this stamp; nullptr if there is none.
  const Point* find(urban_nav_core::StampNs stamp) const;
  /// Returns the total number of points ever added or revised, which serves as a revision.
  std::size_t count() const { return count_; }

 private:
  struct Position {
    urban_nav_core::StampNs stamp = 0;
    Eigen::Vector3d p_odom;
  };
  void placeWaiting();
  static void set(const PlaceBelief& belief, Point& point);

  std::deque<Position> path_;  // last minute
  std::deque<Point> waiting_;  // until odometry reaches their stamps
  std::deque<Point> points_;
  std::size_t count_ = 0;
};

}  // namespace fabmap_node
