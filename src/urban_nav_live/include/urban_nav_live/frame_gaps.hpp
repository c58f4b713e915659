// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_live {

/// Counts missing frames of a stream with a steady rate from the gaps between stamps. The period is the lower quartile
/// of the last intervals, so that a third of the frames may be missing. Not thread-safe.
class FrameGaps {
 public:
  /// Adds a stamp. One that is not later than the previous one restarts the estimate.
  void add(urban_nav_core::StampNs stamp) {
    ++frames_;
    if (newest_ && stamp > *newest_) addInterval(static_cast<double>(stamp - *newest_));
    else count_ = 0;
    newest_ = stamp;
  }
  void restart() {
    newest_.reset();
    count_ = 0;
  }
  std::int64_t frames() const { return frames_; }
  std::int64_t missing() const { return missing_; }

 private:
  static constexpr std::size_t kIntervals = 21, kFewest = 5;

  void addInterval(double interval) {
    if (count_ >= kFewest) {
      const double period = quartile();
      if (interval > 1.5 * period) missing_ += std::llround(interval / period) - 1;
    }
    intervals_[count_++ % kIntervals] = interval;
  }
  double quartile() const {
    std::array<double, kIntervals> sorted = intervals_;
    const std::size_t size = std::min(count_, kIntervals);
    const auto found = sorted.begin() + static_cast<std::ptrdiff_t>(size / 4);
    std::nth_element(sorted.begin(), found, sorted.begin() + static_cast<std::ptrdiff_t>(size));
    return *found;
  }

  std::optional<urban_nav_core::StampNs> newest_;
  std::array<double, kIntervals> intervals_{};  // ns, ring buffer
  std::size_t count_ = 0;                       // number of intervals
  std::int64_t frames_ = 0, missing_ = 0;
};

}  // namespace urban_nav_live
