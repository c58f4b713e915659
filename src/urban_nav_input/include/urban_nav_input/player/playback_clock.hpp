// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// Playback time of a recording: runs `rate` times as fast as the clock of the host, and stops in a pause. Not
/// thread-safe.
class PlaybackClock {
 public:
  using HostTime = std::chrono::steady_clock::time_point;

  /// `begin`: time of the recording at `now`, ns. Requires rate > 0.
  PlaybackClock(urban_nav_core::StampNs begin, double rate, HostTime now, bool is_paused);

  bool isPaused() const { return is_paused_; }
  /// Begins or ends a pause. No effect if already in this state.
  void pause(bool is_paused, HostTime now);
  /// Returns the time of the recording, ns.
  urban_nav_core::StampNs at(HostTime now) const;
  /// Returns the host time of a time of the recording; HostTime::max() in a pause.
  HostTime due(urban_nav_core::StampNs time) const;

 private:
  urban_nav_core::StampNs begin_;  // time of the recording at host_begin_
  double rate_;
  HostTime host_begin_;
  bool is_paused_;
};

}  // namespace urban_nav_input
