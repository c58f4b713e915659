// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/transport/host_clock.hpp"

#include <cstdlib>

namespace segway_drivers {

namespace {

constexpr TimeNs kLeastClockStep = 1'000'000;  // ns

}  // namespace

TimeNs HostClock::follow() {
  const TimeNs offset = read_(), step = offset - offset_;
  if (std::llabs(step) < kLeastClockStep) {
    offset_ += step / 16;  // averages the readings
    return 0;
  }
  offset_ = offset;
  return step;
}

}  // namespace segway_drivers
