// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// Odometry of one session: poses, and the covariance of the relative pose between any two of its times.
///
/// A time between two frames is interpolated; a time shortly outside the chain is extrapolated with the nearest step.
/// The covariance of a relative pose is the sum of the drifts of its steps, plus half of the covariance of the first
/// and of the last step (see RelativePose). It excludes errors common to all steps, such as a scale error
/// (docs/derivations/sliding_window_filter.md). Not thread-safe while steps are appended.
class OdometryChain {
 public:
  /// Appends a step. Returns false, without effect, if it does not begin at the newest frame, is not later or is not
  /// finite.
  bool append(const RelativePose& step);

  bool empty() const { return trajectory_.empty(); }
  /// Returns T_first_base of all frames.
  const Trajectory& trajectory() const { return trajectory_; }

  /// Pose at a time, relative to the frame nearest in time.
  struct NearestFrame {
    StampNs frame = 0;
    Pose T_frame_pose;
  };
  /// Returns nullopt more than 0.1 s outside the chain, and between frames that are more than 1 s apart.
  std::optional<NearestFrame> nearestFrame(StampNs stamp) const;
  /// Returns T_first_base at a time, or nullopt where nearestFrame() does.
  std::optional<Pose> at(StampNs stamp) const;

  /// Returns T_a_b, in either order of time, or nullopt if the pose at a or b is unknown. Poses relative to their
  /// nearest frames are assumed exact. The covariance is positive definite; it is zero between times with the same
  /// nearest frame.
  std::optional<PoseWithCovariance> between(StampNs a, StampNs b) const;
  /// Returns the path length from the first frame to a time, m; outside the chain, to its nearest end.
  double distance(StampNs stamp) const;

 private:
  /// Sums of covariances of consecutive steps, about the pose at the beginning of the first of them: far from it, the
  /// difference of two sums would be lost in rounding.
  struct Block {
    Pose T_first_origin;
    std::vector<Matrix6d> sums;  // of the steps of this block up to and including each
  };
  std::size_t findIndex(StampNs frame) const { return trajectory_.nearest(frame); }
  /// Returns the drift of the steps from + 1 ... to, about the pose of frame `from`.
  Matrix6d drift(std::size_t from, std::size_t to) const;

  Trajectory trajectory_;
  std::vector<double> distances_;
  std::vector<Matrix6d> own_;  // drift of each step, from its beginning, box; zero if the odometry does not provide it
  std::vector<Block> blocks_;
};

}  // namespace urban_nav_core
