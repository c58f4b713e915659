// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// The steps of one session's odometry, and what it says of the way between any two moments of it, however many steps that has.
///
/// A moment between two frames is interpolated, and one just outside the chain is where the nearest step leads: odometry is good for that. The
/// covariance of a way is that of its steps' drifts, with half of the covariance of the first and of the last step (see RelativePose); what all
/// steps have in common, a scale, is not in it. Not thread-safe while it grows.
class OdometryChain {
 public:
  /// False, and left out, where the step does not begin at the newest frame, goes back in time or is not finite.
  bool append(const RelativePose& step);

  bool empty() const { return trajectory_.empty(); }
  /// T_first_base.
  const Trajectory& trajectory() const { return trajectory_; }

  /// Where a moment lies beside the frame nearest to it in time.
  struct Moment {
    StampNs frame = 0;
    Pose T_frame_moment;
  };
  /// Empty more than 0.1 s outside the chain, and between frames that are more than 1 s apart.
  std::optional<Moment> momentOf(StampNs stamp) const;
  /// T_first_base at a moment; empty where momentOf() is.
  std::optional<Pose> at(StampNs stamp) const;

  /// T_a_b, b before or behind a; empty where one of them is not known. Moments beside their frames are taken as surely known there. A
  /// proper covariance, but for zero between moments of one frame.
  std::optional<PoseWithCovariance> between(StampNs a, StampNs b) const;
  /// m driven up to a frame or moment, from the first; of moments outside, that of the nearest end.
  double distance(StampNs stamp) const;

 private:
  /// Sums of covariances of neighbouring steps, about the pose that the first of them begins at: far from where they are, the difference of
  /// two sums would be lost in rounding.
  struct Block {
    Pose T_first_origin;
    std::vector<Matrix6d> sums;  // of the steps of this block up to each, its own included
  };
  std::size_t indexOf(StampNs frame) const { return trajectory_.nearest(frame); }
  /// The drift of the steps from + 1 ... to, about the pose of frame `from`.
  Matrix6d drift(std::size_t from, std::size_t to) const;

  Trajectory trajectory_;
  std::vector<double> distances_;
  std::vector<Matrix6d> own_;  // of each step, from its beginning, box; zero where the odometry tells no drift apart
  std::vector<Block> blocks_;
};

}  // namespace urban_nav_core
