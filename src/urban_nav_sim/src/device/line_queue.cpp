// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/line_queue.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_sim {

namespace {

DeviceTime transferTime(std::size_t bytes, int baud) {
  return static_cast<DeviceTime>(std::llround(1e10 * static_cast<double>(bytes) / baud));
}

}  // namespace

void LineQueue::push(DeviceBytes bytes, DeviceTime begin, int baud, DeviceTime excess) {
  const DeviceTime start = std::max(begin, free_from_);
  free_from_ = start + transferTime(bytes.size(), baud);
  frames_.push_back({std::move(bytes), 0, start, excess, baud});
}

DeviceBytes LineQueue::take(int host_baud, DeviceTime now) {
  DeviceBytes arrived;
  while (!frames_.empty() && last_arrival_ <= now) {
    QueuedFrame& frame = frames_.front();
    const double elapsed = static_cast<double>(now - frame.begin - frame.excess);
    const auto due = static_cast<std::size_t>(
        std::clamp(std::floor(elapsed * frame.baud / 1e10), 0.0, static_cast<double>(frame.bytes.size())));
    for (; frame.sent < due; ++frame.sent) {
      if (frame.baud == host_baud) arrived.push_back(frame.bytes[frame.sent]);
      else if (noise_() % 2 == 0)
        arrived.push_back(static_cast<std::uint8_t>(noise_() % 3 == 0 ? 0xF8 : 0xE0 + noise_() % 32));
    }
    if (frame.sent < frame.bytes.size()) break;
    last_arrival_ = std::max(last_arrival_, frame.begin + frame.excess + transferTime(frame.bytes.size(), frame.baud));
    frames_.pop_front();
  }
  return arrived;
}

}  // namespace urban_nav_sim
