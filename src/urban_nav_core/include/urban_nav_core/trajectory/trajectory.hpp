// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Pose T_world_body at a time, for any two frames.
struct StampedPose {
  StampNs stamp = 0;
  Pose pose;
};

/// Poses in order of time, with strictly increasing stamps.
class Trajectory {
 public:
  Trajectory() = default;
  /// Asserts that stamps increase; readers check this before.
  explicit Trajectory(std::vector<StampedPose> poses);

  /// Appends a pose. Returns false, without effect, if the stamp is not later than the last one.
  bool append(StampNs stamp, const Pose& pose);

  bool empty() const { return poses_.empty(); }
  std::size_t size() const { return poses_.size(); }
  const StampedPose& operator[](std::size_t i) const { return poses_[i]; }
  const StampedPose& front() const { return poses_.front(); }
  const StampedPose& back() const { return poses_.back(); }
  std::vector<StampedPose>::const_iterator begin() const { return poses_.begin(); }
  std::vector<StampedPose>::const_iterator end() const { return poses_.end(); }

  /// Returns the pose at a time between the first and the last stamp, interpolated between neighbours
  /// (interpolate.hpp); empty outside, or if the neighbours are further apart than `max_gap`.
  std::optional<Pose> at(StampNs stamp, StampNs max_gap) const;
  /// Returns the index of the pose nearest in time, the earlier of two equally near. Requires a non-empty trajectory.
  std::size_t nearest(StampNs stamp) const;
  /// Returns the length of the path, m.
  double length() const;

 private:
  std::vector<StampedPose> poses_;
};

/// Returns T_new_world * T_world_body for every pose.
Trajectory transformed(const Pose& T_new_world, const Trajectory& trajectory);

/// Returns whether stamps are equal and poses agree within `tolerance` (m, rad).
bool isApprox(const Trajectory& a, const Trajectory& b, double tolerance);
/// Prints "77 poses from 0.000000000 to 7.600000000 s, 85.3 m".
std::ostream& operator<<(std::ostream& out, const Trajectory& trajectory);

}  // namespace urban_nav_core
