// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/stamp.hpp"

#include <algorithm>
#include <limits>

namespace urban_nav_ros {

using urban_nav_core::StampNs;

namespace {
constexpr StampNs kSecond = 1'000'000'000;
}

StampNs toStampNs(const ros::Time& time) {
  return static_cast<StampNs>(time.sec) * kSecond + static_cast<StampNs>(time.nsec);
}

ros::Time toRosTime(StampNs stamp) {
  constexpr StampNs kLast = static_cast<StampNs>(std::numeric_limits<std::uint32_t>::max()) * kSecond + kSecond - 1;
  const StampNs clamped = std::clamp<StampNs>(stamp, 0, kLast);
  return ros::Time(static_cast<std::uint32_t>(clamped / kSecond), static_cast<std::uint32_t>(clamped % kSecond));
}

}  // namespace urban_nav_ros
