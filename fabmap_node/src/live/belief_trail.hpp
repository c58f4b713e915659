// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <string>

#include "fabmap_node/fab_map.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace fabmap_node {

/// Beliefs of the last observations, each where odometry was, for a picture of them. Its memory is bounded. Not
/// thread-safe.
class BeliefTrail {
 public:
  struct Point {
    urban_nav_core::StampNs stamp = 0;
    Eigen::Vector3d p_odom = Eigen::Vector3d::Zero();  ///< m
    PlaceKnowledge knowledge = PlaceKnowledge::New;
    double p_new = 1.0;
    std::optional<LikelyPlace> likeliest;  ///< of its places
  };

  /// Adds a pose of odometry. A stamp that jumps back begins a path of its own.
  void addOdometry(const urban_nav_core::StampedPose& T_odom_base);
  /// Adds a belief, once odometry has reached its stamp; none of an unused observation or of a stationary robot. A
  /// stamp that jumps back clears the trail.
  void add(const PlaceBelief& belief);
  void clear();

  /// Returns the beliefs in order of time.
  const std::deque<Point>& points() const { return points_; }
  /// Returns the point of the observation with a stamp; nullptr if there is none.
  const Point* find(urban_nav_core::StampNs stamp) const;
  /// Returns the number of points that were ever added: it changes with them.
  std::size_t count() const { return count_; }

 private:
  struct Position {
    urban_nav_core::StampNs stamp = 0;
    Eigen::Vector3d p_odom;
  };
  void placeWaiting();

  std::deque<Position> path_;  // the last minute
  std::deque<Point> waiting_;  // for odometry of their stamps
  std::deque<Point> points_;
  std::size_t count_ = 0;
};

}  // namespace fabmap_node
