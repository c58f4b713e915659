// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "world/world.hpp"

namespace urban_nav_sim {

/// A route as a line without end, by the length driven along it: round after round where it is closed, else there and
/// back. Immutable, so thread-safe.
class RoutePath {
 public:
  /// Position that the robot must reach before it continues: to pause, or to turn round.
  struct Stop {
    double at = 0.0;     ///< m along the way
    double pause = 0.0;  ///< s
  };

  /// Throws UserError where the route is too short. `length`: how much of it is needed, m.
  RoutePath(const Route& route, double length);

  double length() const { return along_.back(); }
  Eigen::Vector2d at(double s) const;         ///< m, in `world`
  Eigen::Vector2d direction(double s) const;  ///< unit; of the piece that begins at `s` where two meet
  double speed(double s) const;               ///< wanted, m/s
  /// The first stop further than `s`.
  std::optional<Stop> nextStop(double s) const;

 private:
  std::size_t pieceAt(double s) const;

  std::vector<Eigen::Vector2d> points_;
  std::vector<double> along_;   ///< of each point, m
  std::vector<double> speeds_;  ///< on the way to each point
  std::vector<Stop> stops_;
};

}  // namespace urban_nav_sim
