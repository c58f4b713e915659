// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/drift_sandwich.hpp"
#include "window/offset_sandwich.hpp"

namespace swf_vo {

/// Scores of the landmarks of a window by slot, and their sums over ended landmarks.
class LandmarkScores {
 public:
  /// Resets at the begin of a session; keeps the memory.
  void clear();
  /// Reserves memory for this number of landmarks.
  void reserve(std::size_t slots) { scores_.reserve(slots); }

  /// Adds a measurement that leaves the window with its pose.
  void add(std::size_t slot, const LandmarkBlock& landmark, const PoseBlock& pose, const SensorTerm& term);
  /// Adds template drift to the bearing (covariance), before the next measurement of this landmark leaves.
  void age(std::size_t slot, const Eigen::Matrix2d& covariance);
  /// Adds the final scores of the landmarks in these slots, which have ended.
  void end(const std::vector<int>& slots, const urban_nav_core::Pose& T_odom_camera);
  /// Advances the oldest pose by this step, as seen from `state.poses.front()`. The view change is the rotation angle
  /// plus the distance over the typical depth (rad).
  void advance(const State& state, const urban_nav_core::Pose& T_from_to);

  const DriftSandwich& sandwich() const { return sandwich_; }
  const OffsetSandwich& ofOffset() const { return of_offset_; }
  void archive(urban_nav_core::Archive& archive);

 private:
  double view_change_ = 0.0;  // rad, since the start
  std::vector<LandmarkScore> scores_;
  DriftSandwich sandwich_;
  OffsetSandwich of_offset_;
  std::vector<double> inverse_depths_;
};

}  // namespace swf_vo
