// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <random>
#include <vector>

namespace urban_nav_sim {

/// Host time, ns.
using DeviceTime = std::int64_t;
using DeviceBytes = std::vector<std::uint8_t>;

/// Serial line from a device to the host: bytes are sent at the line rate, and arrive in order, delayed by the excess
/// delay of their frame. Deterministic.
class LineQueue {
 public:
  /// Appends a frame to send at `begin`, ns, or when the line is free; `excess`: ns between line and host.
  void push(DeviceBytes bytes, DeviceTime begin, int baud, DeviceTime excess = 0);
  /// Returns the bytes that have arrived by `now`; noise if the host uses another line rate.
  DeviceBytes take(int host_baud, DeviceTime now);
  bool empty() const { return frames_.empty(); }
  void clear() { frames_.clear(); }

 private:
  struct QueuedFrame {
    DeviceBytes bytes;
    std::size_t sent = 0;
    DeviceTime begin = 0, excess = 0;
    int baud = 0;
  };
  std::deque<QueuedFrame> frames_;
  DeviceTime free_from_ = 0, last_arrival_ = 0;
  std::minstd_rand noise_{7};
};

}  // namespace urban_nav_sim
