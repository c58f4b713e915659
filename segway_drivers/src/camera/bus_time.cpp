// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/camera/bus_time.hpp"

#include <cmath>

namespace segway_drivers {

std::optional<double> parseBusTime(std::uint32_t word) {
  const std::uint32_t seconds = word >> 25, cycle = word >> 12 & 0x1FFFU, offset = word & 0xFF0U;
  if (cycle >= 8000 || offset >= 3072) return std::nullopt;
  return seconds + cycle / 8000.0 + offset / 24.576e6;
}

TimeNs hostTimeOfBusTime(double event_s, double now_s, TimeNs now) {
  double age = std::fmod(now_s - event_s, kBusTimeWrap);
  if (age < 0.0) age += kBusTimeWrap;
  if (age > kBusTimeWrap - 1.0) age -= kBusTimeWrap;  // an event shortly after the instant
  return now - static_cast<TimeNs>(std::llround(1e9 * age));
}

}  // namespace segway_drivers
