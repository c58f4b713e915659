// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <optional>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_core {

/// Stamps of truth and estimate count as the same time within this.
constexpr StampNs kAssociationTolerance = 20000000;

/// Poses of truth and estimate at the same times, in order of time; all vectors are equally long.
struct Matched {
  std::vector<StampNs> stamps;  ///< of the estimate, shifted onto the truth's clock
  std::vector<Pose> truth;
  std::vector<Pose> estimate;
  std::vector<std::size_t> estimate_index;  ///< place in the estimate's trajectory
};

/// For each pose of the estimate the truth at its stamp plus `offset`: interpolated between two poses at most 0.1 s
/// apart, else the nearest; only where a truth pose lies within `tolerance`. A truth pose that is not interpolated
/// serves once, the nearest estimate.
Matched associate(const Trajectory& truth, const Trajectory& estimate, StampNs offset = 0,
                  StampNs tolerance = kAssociationTolerance);
/// Files without stamps: line by line. Empty where the lengths differ.
std::optional<Matched> associateByIndex(const std::vector<Pose>& truth, const std::vector<Pose>& estimate);

/// What to add to the estimate's stamps so that it fits the truth.
struct TimeOffset {
  StampNs offset = 0;
  /// Of the two motions, 1 at best; 0 where the offset lines up the first stamps for want of motion.
  double correlation = 0.0;
  std::size_t matched = 0;  ///< poses that associate() finds with it
};
/// By correlating speeds and turning rates, which do not depend on frames, over all shifts that overlap by at least 30
/// % of the shorter one; resolution about 1 ms. Where neither moves, or the best correlation is under 0.5: first stamp
/// onto first stamp. Empty for trajectories of fewer than two poses.
std::optional<TimeOffset> findOffset(const Trajectory& truth, const Trajectory& estimate);

std::ostream& operator<<(std::ostream& out, const TimeOffset& offset);

}  // namespace urban_nav_core
