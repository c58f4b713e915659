// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/player/playback_clock.hpp"

#include <cmath>

namespace urban_nav_input {

using std::chrono::nanoseconds;
using urban_nav_core::StampNs;

PlaybackClock::PlaybackClock(StampNs begin, double rate, HostTime now, bool is_paused)
    : begin_(begin), rate_(rate), host_begin_(now), is_paused_(is_paused) {}

void PlaybackClock::pause(bool is_paused, HostTime now) {
  if (is_paused == is_paused_) return;
  begin_ = at(now);
  host_begin_ = now;
  is_paused_ = is_paused;
}

StampNs PlaybackClock::at(HostTime now) const {
  if (is_paused_) return begin_;
  const auto passed = static_cast<double>(std::chrono::duration_cast<nanoseconds>(now - host_begin_).count());
  return begin_ + static_cast<StampNs>(std::llround(passed * rate_));
}

PlaybackClock::HostTime PlaybackClock::due(StampNs time) const {
  if (is_paused_) return HostTime::max();
  return host_begin_ + nanoseconds(std::llround(static_cast<double>(time - begin_) / rate_));
}

}  // namespace urban_nav_input
