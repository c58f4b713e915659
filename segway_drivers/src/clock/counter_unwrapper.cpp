// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/clock/counter_unwrapper.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace segway_drivers {

UnwrappedCount CounterUnwrapper::add(std::uint32_t counter, TimeNs arrival) {
  UnwrappedCount result;
  const bool first = !last_;
  const bool timed = arrival != 0 && last_arrival_ != 0;
  const auto elapsed = timed ? std::llround(1e-9 * static_cast<double>(arrival - last_arrival_) / period_) : 1LL;
  std::int64_t step = first ? 0 : std::max<std::int64_t>(elapsed, 1);
  if (!first && modulus_ > 0) {
    const std::int64_t modulus = modulus_, difference = (counter + modulus_ - *last_ % modulus_) % modulus_;
    step = difference;
    if (timed && elapsed > difference) step += modulus * ((elapsed - difference + modulus / 2) / modulus);
    result.repeated = step == 0;
    result.restarted =
        timed ? std::llabs(step - elapsed) > std::max<std::int64_t>(modulus / 4, 1) : difference > modulus / 2;
  }
  if (result.restarted) step = 1;
  count_ += step;
  result.count = count_;
  if (!first && step > 1) result.missing = step - 1;
  last_ = counter;
  last_arrival_ = arrival;
  return result;
}

}  // namespace segway_drivers
