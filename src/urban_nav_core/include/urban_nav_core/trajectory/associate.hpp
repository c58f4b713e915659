// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <optional>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_core {

/// Largest difference, ns, at which stamps of truth and estimate count as equal.
constexpr StampNs kAssociationTolerance = 20000000;

/// Poses of truth and estimate at the same times, in order of time; all vectors are equally long.
struct Matched {
  std::vector<StampNs> stamps;  ///< of the estimate, shifted onto the truth's clock
  std::vector<Pose> truth;
  std::vector<Pose> estimate;
  std::vector<std::size_t> estimate_index;  ///< place in the estimate's trajectory
};

/// Associates each pose of the estimate with the truth at its stamp plus `offset`: interpolated between two poses at
/// most 0.1 s apart, else the nearest; only if a truth pose lies within `tolerance`. A truth pose that is not
/// interpolated is used once, for the nearest estimate.
Matched associate(const Trajectory& truth, const Trajectory& estimate, StampNs offset = 0,
                  StampNs tolerance = kAssociationTolerance);
/// Associates poses without stamps, by index. Empty if the lengths differ.
std::optional<Matched> associateByIndex(const std::vector<Pose>& truth, const std::vector<Pose>& estimate);

/// Offset to be added to the estimate's stamps.
struct TimeOffset {
  StampNs offset = 0;
  /// Correlation of the two motions, 1 at best; 0 if the first stamps were aligned for lack of motion.
  double correlation = 0.0;
  std::size_t matched = 0;  ///< poses that associate() matches with this offset
};
/// Estimates the offset by correlating speeds and angular rates, which do not depend on frames, over all shifts with an
/// overlap of at least 30 % of the shorter trajectory; resolution about 1 ms. If neither moves, or the best correlation
/// is under 0.5, aligns the first stamps. Empty for trajectories of fewer than two poses.
std::optional<TimeOffset> findOffset(const Trajectory& truth, const Trajectory& estimate);

std::ostream& operator<<(std::ostream& out, const TimeOffset& offset);

}  // namespace urban_nav_core
