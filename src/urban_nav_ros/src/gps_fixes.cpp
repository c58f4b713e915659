// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/gps_fixes.hpp"

#include <utility>

namespace urban_nav_ros {

using urban_nav_core::PositionFix;
using urban_nav_core::Vector3d;

namespace {

constexpr std::size_t kMostWaitingFixes = 60;

}  // namespace

std::vector<PositionFix> GpsFixes::add(const sensor_msgs::NavSatFix& message) {
  const auto reading = toGpsReading(message);
  if (!reading) return {};
  if (!frame_) frame_ = message.header.frame_id;
  waiting_.push_back({*reading, Vector3d::Zero()});
  return takeConverted();
}

std::vector<PositionFix> GpsFixes::add(const tf2_msgs::TFMessage& message) {
  transforms_.add(message);
  return takeConverted();
}

std::vector<PositionFix> GpsFixes::takeConverted() {
  if ((!p_base_ || is_assumed_) && frame_) {
    if (const auto T_base_gps = transforms_.lookup(base_frame_, *frame_)) {
      p_base_ = T_base_gps->t();
      is_assumed_ = false;
    } else if (!p_base_ && waiting_.size() >= kMostWaitingFixes) {
      p_base_ = Vector3d::Zero();
      is_assumed_ = true;
    }
  }
  if (!p_base_) return {};
  std::vector<PositionFix> made = std::exchange(waiting_, {});
  for (PositionFix& fix : made) fix.p_base = *p_base_;
  return made;
}

}  // namespace urban_nav_ros
