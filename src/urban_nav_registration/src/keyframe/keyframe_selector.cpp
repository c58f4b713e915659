// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/keyframe/keyframe_selector.hpp"

namespace urban_nav_registration {

bool KeyframeSelector::select(const urban_nav_core::Pose& T_odom_base) {
  if (last_ && distanceBetween(*last_, T_odom_base) < distance_ && angleBetween(*last_, T_odom_base) < angle_)
    return false;
  last_ = T_odom_base;
  return true;
}

}  // namespace urban_nav_registration
