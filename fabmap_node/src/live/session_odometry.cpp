// SPDX-License-Identifier: BSD-3-Clause
#include "live/session_odometry.hpp"

#include <utility>

namespace fabmap_node {

void SessionOdometry::add(const urban_nav_core::StampedPose& T_odom_base) {
  const bool jumped = time_.add(T_odom_base.stamp);
  if (jumped && !is_late_) next_.emplace();
  if (jumped) is_late_ = false;
  if (is_late_) return;  // of the ended session
  Part& part = next_ ? *next_ : current_;
  if (!part.start) part.start = T_odom_base.stamp;
  part.travelled.add(T_odom_base.stamp, T_odom_base.pose.t());
}

void SessionOdometry::beginNextSession() {
  is_late_ = !next_ && time_.newest();
  current_ = std::exchange(next_, std::nullopt).value_or(Part());
}

}  // namespace fabmap_node
