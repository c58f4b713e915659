// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>

#include "urban_nav_core/sequence/time_jump.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_live {

using urban_nav_core::kMaxStepBack;

/// Detects stamps that jump back by more than kMaxStepBack. Not thread-safe.
class TimeJumpDetector {
 public:
  /// Returns true if `stamp` lies more than kMaxStepBack before the newest one.
  bool jumpsBack(urban_nav_core::StampNs stamp) const { return newest_ && urban_nav_core::jumpsBack(stamp, *newest_); }
  /// Raises the newest stamp; an earlier stamp has no effect.
  void advance(urban_nav_core::StampNs stamp) { newest_ = std::max(newest_.value_or(stamp), stamp); }
  /// Returns jumpsBack(stamp). After a jump `stamp` becomes the newest one, otherwise advance(stamp) applies.
  bool add(urban_nav_core::StampNs stamp) {
    const bool jumps = jumpsBack(stamp);
    if (jumps) newest_.reset();
    advance(stamp);
    return jumps;
  }
  void reset() { newest_.reset(); }
  const std::optional<urban_nav_core::StampNs>& newest() const { return newest_; }

 private:
  std::optional<urban_nav_core::StampNs> newest_;
};

}  // namespace urban_nav_live
