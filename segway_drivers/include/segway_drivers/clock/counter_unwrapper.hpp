// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Position of a measurement in the sequence of its device.
struct UnwrappedCount {
  std::int64_t count = 0;    ///< measurements since the first, losses included
  std::int64_t missing = 0;  ///< measurements lost since the previous one
  bool repeated = false;     ///< the counter has not changed
  bool restarted = false;    ///< the counter contradicts the arrival times: the device has restarted
};

/// Unwraps a counter of few bits by rounding to the elapsed arrival time. Deterministic. Not thread-safe.
class CounterUnwrapper {
 public:
  /// `modulus`: number of counter values; 0: no counter, measurements are counted by arrival time. `period`: s between
  /// measurements.
  CounterUnwrapper(std::uint32_t modulus, double period) : modulus_(modulus), period_(period) {}

  /// `arrival` in ns; 0: unknown, and a gap is less than one wrap.
  UnwrappedCount add(std::uint32_t counter, TimeNs arrival);
  void setPeriod(double period) { period_ = period; }
  void reset() { last_.reset(); }

 private:
  std::uint32_t modulus_;
  double period_;
  std::optional<std::uint32_t> last_;
  TimeNs last_arrival_ = 0;
  std::int64_t count_ = 0;
};

}  // namespace segway_drivers
