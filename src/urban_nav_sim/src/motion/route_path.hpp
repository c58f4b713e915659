// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "world/world.hpp"

namespace urban_nav_sim {

/// A route as an endless path, parametrised by the distance driven: repeated if closed, otherwise back and forth.
/// Immutable, so thread-safe.
class RoutePath {
 public:
  /// Position that the robot must reach before it continues: to pause or to turn around.
  struct Stop {
    double at = 0.0;     ///< m along the path
    double pause = 0.0;  ///< s
  };

  /// Throws UserError if the route is too short. `length`: required length of the path, m.
  RoutePath(const Route& route, double length);

  double length() const { return along_.back(); }
  Eigen::Vector2d at(double s) const;         ///< m, in `world`
  Eigen::Vector2d direction(double s) const;  ///< unit; at a junction that of the segment that begins at `s`
  double speed(double s) const;               ///< desired, m/s
  /// Returns the first stop beyond `s`.
  std::optional<Stop> nextStop(double s) const;

 private:
  std::size_t pieceAt(double s) const;

  std::vector<Eigen::Vector2d> points_;
  std::vector<double> along_;   ///< distance of each point, m
  std::vector<double> speeds_;  ///< on the segment to each point, m/s
  std::vector<Stop> stops_;
};

}  // namespace urban_nav_sim
