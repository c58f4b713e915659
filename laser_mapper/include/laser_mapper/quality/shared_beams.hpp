// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "laser_mapper/quality/plane_constraints.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// Closures by ICP between two clouds of a map: by sessions, as indices of its trajectories, and stamps.
struct CloudClosure {
  std::size_t session_a = 0, session_b = 0;
  urban_nav_core::StampNs stamp_a = 0, stamp_b = 0;
};

/// Parts of the path whose beams closures by ICP have used. Immutable, so thread-safe.
class SharedBeams {
 public:
  /// `cloud_half_length`: of the clouds that the closures rest on, m along the path to both sides of their stamps.
  SharedBeams(const std::vector<const urban_nav_core::Trajectory*>& T_map_base,
              const std::vector<CloudClosure>& closures, double cloud_half_length);

  /// Returns whether a closure rests on beams of both stretches of a constraint, one in each of its clouds. Their
  /// errors are then not independent.
  bool areUsedBy(const PlaneConstraint& constraint) const;

 private:
  /// Distances along the path of a session at its poses.
  struct PathLengths {
    std::vector<urban_nav_core::StampNs> stamps;
    std::vector<double> lengths;  ///< m
    double at(urban_nav_core::StampNs stamp) const;
  };
  struct Interval {
    std::size_t session = 0;
    double from = 0.0, to = 0.0;  ///< m
    bool overlaps(const Interval& other) const;
  };
  Interval stretch(std::size_t session, std::int64_t number) const;

  std::vector<PathLengths> paths_;  ///< by session
  std::vector<std::pair<Interval, Interval>> clouds_;
};

}  // namespace laser_mapper
