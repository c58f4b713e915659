// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/keyframe_choice.hpp"

namespace loop_metric {

bool KeyframeChoice::choose(const urban_nav_core::Pose& T_odom_base) {
  if (last_ && distanceBetween(*last_, T_odom_base) < way_ && angleBetween(*last_, T_odom_base) < turn_) return false;
  last_ = T_odom_base;
  return true;
}

}  // namespace loop_metric
