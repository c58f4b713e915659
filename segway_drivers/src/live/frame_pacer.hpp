// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>

#include "segway_drivers/camera/sim_source.hpp"
#include "segway_drivers/transport/port.hpp"

namespace segway_drivers {

/// Paces a simulated camera by odometry, so that a slow machine drops no frames. Odometry answers a frame with its
/// stamp. Frames of a session that odometry has not started are not answered; after kPatience the next frame is
/// exposed without an answer. Times are arguments; no clock is read. Thread-safe.
class FramePacer {
 public:
  static constexpr std::size_t kAhead = 10;           ///< frames that may be unanswered
  static constexpr TimeNs kPatience = 2'000'000'000;  ///< ns since the newest frame

  /// Reports a frame with this stamp, published at `now`. Stamps increase.
  void sent(TimeNs stamp, TimeNs now);
  /// Reports that odometry has processed all frames up to this stamp.
  void answered(TimeNs stamp);
  /// Returns whether the next frame may be exposed at `now`.
  bool isFree(TimeNs now) const;
  /// Returns a reader whose frames wait until they may be exposed and while `is_absent` returns true, unless `stop` is
  /// set. `stop` and this object must outlive it.
  FrameReader pace(FrameReader read, std::function<bool()> is_absent, const std::atomic<bool>& stop) const;

 private:
  mutable std::mutex mutex_;       // guards everything below
  std::deque<TimeNs> unanswered_;  // stamps, oldest first
  TimeNs newest_ = 0;              // time at which the newest frame was published
};

}  // namespace segway_drivers
