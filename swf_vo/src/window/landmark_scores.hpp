// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/drift_sandwich.hpp"
#include "window/offset_sandwich.hpp"

namespace swf_vo {

/// The scores of the landmarks of a window by slot, and what those of dead landmarks say together.
class LandmarkScores {
 public:
  /// Begins anew, as with a session; keeps the memory.
  void clear();
  /// Room for so many landmarks.
  void reserve(std::size_t slots) { scores_.reserve(slots); }

  /// A measurement that leaves the window with its pose.
  void add(std::size_t slot, const LandmarkBlock& landmark, const PoseBlock& pose, const SensorTerm& term);
  /// Adds template drift to the bearing (covariance), before the next measurement of this landmark leaves.
  void age(std::size_t slot, const Eigen::Matrix2d& covariance);
  /// The landmarks in these slots have died: nothing more will be added to them.
  void end(const std::vector<int>& slots, const urban_nav_core::Pose& T_odom_camera);
  /// The oldest pose goes on by this step, seen from `state.poses.front()`. A view changes by the angle turned and the
  /// distance over the usual depth (rad).
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
