// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>

#include "segway_drivers/transport/port.hpp"

namespace segway_drivers {

/// Converts times of the steady clock of drivers to real time. Follows slewing of the real clock and reports its steps.
/// Not thread-safe.
class HostClock {
 public:
  /// `read`: real time minus steady time, ns.
  explicit HostClock(std::function<TimeNs()> read = realTimeOffset) : read_(std::move(read)), offset_(read_()) {}

  TimeNs toReal(TimeNs steady) const { return steady + offset_; }
  /// Must be called often. Returns the size of a step of the real clock, ns, beyond 1 ms; otherwise 0.
  TimeNs follow();

 private:
  std::function<TimeNs()> read_;
  TimeNs offset_;
};

}  // namespace segway_drivers
