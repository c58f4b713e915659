// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/camera/turned_right_camera.hpp"
#include "urban_nav_core/sequence/stereo_assembler.hpp"

namespace urban_nav_core {

/// Turn of the right camera against its calibrated orientation, as odometry found it for the frame of this stamp
/// (TurnedRightCamera).
struct StampedTurn {
  StampNs stamp = 0;
  Vector3d turn = Vector3d::Zero();  ///< rad
};

/// Corrects the right images of stereo pairs by the turns of a session, for stages that read images after odometry.
/// Memory is bounded by the number of knocks. Not thread-safe.
class RightCameraTurns {
 public:
  explicit RightCameraTurns(const StereoCamera& camera) : right_(camera) {}

  /// Adds the turn of a frame, which holds until the next one. Turns that are not finite and stamps that are not later
  /// than those before are ignored.
  void add(const StampedTurn& turn);
  /// Replaces the right image of a pair, with its owner, by the corrected one; does nothing where there is no turn.
  void correct(StereoPairWithMotion& frame);

 private:
  TurnedRightCamera right_;
  std::vector<StampedTurn> changes_;
  StampNs last_ = 0;
};

}  // namespace urban_nav_core
