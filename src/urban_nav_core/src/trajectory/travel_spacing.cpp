// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/travel_spacing.hpp"

#include <cstdlib>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_core {

bool TravelSpacing::takes(StampNs stamp, const std::optional<Pose>& T_odom_base) {
  constexpr StampNs kLongestRest = 10'000'000'000;  // ns
  const bool has_moved = T_odom_base.has_value() != T_odom_base_.has_value() ||
                         (T_odom_base && (distanceBetween(*T_odom_base, *T_odom_base_) >= spacing_.distance ||
                                          angleBetween(*T_odom_base, *T_odom_base_) >= spacing_.angle));
  if (any_ && !has_moved && std::abs(stamp - stamp_) < kLongestRest) return false;
  any_ = true;
  stamp_ = stamp;
  T_odom_base_ = T_odom_base;
  return true;
}

void TravelSpacing::archive(Archive& archive) { archive(any_, stamp_, T_odom_base_); }

}  // namespace urban_nav_core
