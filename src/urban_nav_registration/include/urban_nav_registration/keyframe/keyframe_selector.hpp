// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_registration/parameters.hpp"

namespace urban_nav_registration {

/// Selects the keyframes of a session: the first frame, and each frame at the keyframe distance or angle from the last
/// one, by filtered odometry. Used by live and offline stages, so that a session and its recording have the same
/// keyframes. Not thread-safe.
class KeyframeSelector {
 public:
  explicit KeyframeSelector(const Parameters& parameters)
      : distance_(parameters.keyframe_distance), angle_(parameters.keyframe_angle) {}

  /// Sets the pose of the last keyframe, relative to which the next ones are selected.
  void keep(const urban_nav_core::Pose& T_odom_base) { last_ = T_odom_base; }
  /// Returns true if the frame is a keyframe. Call for each frame in order of time.
  bool select(const urban_nav_core::Pose& T_odom_base);

 private:
  double distance_, angle_;
  std::optional<urban_nav_core::Pose> last_;  // T_odom_base of the last keyframe
};

}  // namespace urban_nav_registration
