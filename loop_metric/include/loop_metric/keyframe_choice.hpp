// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "loop_metric/parameters.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace loop_metric {

/// Which views of a session are kept: the first, and each one behind so much way or so much of a turn, by odometry as it was at the moment. Whoever
/// keeps views asks it, so that a live session and its recording keep the same ones.
class KeyframeChoice {
 public:
  explicit KeyframeChoice(const Parameters& parameters)
      : way_(parameters.keyframe_way), turn_(parameters.keyframe_turn) {}

  /// A view was kept here; the next ones are measured from it.
  void keep(const urban_nav_core::Pose& T_odom_base) { last_ = T_odom_base; }
  /// To be asked for each frame in order of time. True: its view is kept.
  bool choose(const urban_nav_core::Pose& T_odom_base);

 private:
  double way_, turn_;
  std::optional<urban_nav_core::Pose> last_;  // T_odom_base of the last view that was kept
};

}  // namespace loop_metric
