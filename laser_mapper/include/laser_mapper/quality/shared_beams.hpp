// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "laser_mapper/quality/plane_constraints.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// ICP closure between two clouds of a map, given by session indices and stamps.
struct CloudClosure {
  std::size_t session_a = 0, session_b = 0;
  urban_nav_core::StampNs stamp_a = 0, stamp_b = 0;
  urban_nav_core::Constraint measured;  ///< T_a_b of base_link
};

/// ICP closures, with the parts of the path whose beams they use. Immutable, hence thread-safe.
class SharedBeams {
 public:
  /// `T_map_base`: must outlive it. `cloud_half_length`: of the clouds of the closures, m along the path to either side
  /// of their stamps.
  SharedBeams(const std::vector<const urban_nav_core::Trajectory*>& T_map_base, std::vector<CloudClosure> closures,
              double cloud_half_length);

  /// Subtracts from the constraints the information that closures have from the same beams, so that it is counted once.
  /// A closure shares beams with a constraint if its clouds overlap both intervals. The closure's information is
  /// distributed evenly along the clouds; the part on a constraint's intervals is transferred to its poses along the
  /// trajectory and subtracted, in directions where something is left. A constraint without remaining information has
  /// zero information. `constraints`: all of them, since those within one closure's clouds share its part.
  std::vector<PlaneConstraint> discount(std::vector<PlaneConstraint> constraints) const;

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
    /// Returns the length of the intersection of two intervals, m.
    double common(const Interval& other) const;
  };
  /// Overlap of a closure and a constraint.
  struct Common {
    double length = 0.0;       ///< m along the clouds
    bool is_reversed = false;  ///< the constraint's a lies in the closure's b
  };
  Interval stretch(std::size_t session, std::int64_t number) const;
  Common common(const std::pair<Interval, Interval>& clouds, const PlaneConstraint& constraint) const;
  urban_nav_core::Matrix6d carry(const CloudClosure& closure, bool is_reversed, const PlaneConstraint& to) const;

  const std::vector<const urban_nav_core::Trajectory*> T_map_base_;  ///< by session
  const std::vector<CloudClosure> closures_;
  const double cloud_length_;                          ///< m
  std::vector<PathLengths> paths_;                     ///< by session
  std::vector<std::pair<Interval, Interval>> clouds_;  ///< of each closure
};

}  // namespace laser_mapper
