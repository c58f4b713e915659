// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>

#include "segway_drivers/camera/sim_source.hpp"
#include "segway_drivers/transport/port.hpp"

namespace segway_drivers {

/// Lets a simulated camera expose frames as fast as odometry takes them, so that a slow machine leaves none out.
/// Odometry answers a frame with its stamp. It does not answer those of a session that it has not begun yet; after
/// kPatience the next one is exposed all the same. Times are arguments; no clock is read. Thread-safe.
class FramePacer {
 public:
  static constexpr std::size_t kAhead = 10;           ///< frames that may be unanswered
  static constexpr TimeNs kPatience = 2'000'000'000;  ///< ns since the newest frame

  /// A frame with this stamp was published at `now`. Stamps increase.
  void sent(TimeNs stamp, TimeNs now);
  /// Odometry has taken the frame with this stamp, and so all before it.
  void answered(TimeNs stamp);
  /// Returns whether the next frame may be exposed at `now`.
  bool isFree(TimeNs now) const;
  /// Returns a reader whose frames wait until they may be exposed, and while `is_absent` returns true; no longer once
  /// `stop` is set. Both must outlive it, as this object.
  FrameReader pace(FrameReader read, std::function<bool()> is_absent, const std::atomic<bool>& stop) const;

 private:
  mutable std::mutex mutex_;       // guards everything below
  std::deque<TimeNs> unanswered_;  // stamps, oldest first
  TimeNs newest_ = 0;              // time at which the newest frame was published
};

}  // namespace segway_drivers
