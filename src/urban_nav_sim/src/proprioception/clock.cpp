// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/clock.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_sim {

using urban_nav_core::StampNs;

Clock::Clock(StampNs begin, const ClockOptions& options, const Noise& noise)
    : begin_(begin), options_(options), noise_(noise) {}

StampNs Clock::taken(double t) const { return begin_ + static_cast<StampNs>(std::llround(t * 1e9)); }

StampNs Clock::stamp(std::int64_t k, double t) const {
  const double jitter = options_.jitter > 0.0
                            ? std::clamp(noise_.normal(static_cast<std::uint64_t>(k)), -3.0, 3.0) * options_.jitter
                            : 0.0;
  const double off = options_.offset + options_.skew * t + jitter;
  return taken(t) + static_cast<StampNs>(std::llround(off * 1e9));
}

ClockOptions correctedClock(Sensor sensor) {
  ClockOptions options;
  switch (sensor) {
    case Sensor::Stereo: options.jitter = 50e-6; break;
    case Sensor::Ladybug: options.jitter = 1e-3; break;
    case Sensor::Lasers:
    case Sensor::Lidar3d:
    case Sensor::Imu: options.jitter = 20e-6; break;
    case Sensor::Wheels: options.jitter = 500e-6; break;
    case Sensor::Gps: options.jitter = 5e-3; break;
  }
  return options;
}

ClockOptions uncorrectedClock(Sensor sensor, std::uint64_t seed) {
  const Noise noise = Noise(seed, "clock").of(static_cast<std::uint64_t>(sensor));
  ClockOptions options = correctedClock(sensor);
  options.offset = noise.uniform(0, -0.5, 0.5);
  options.skew = sensor == Sensor::Lasers ? 360e-6 : noise.uniform(1, -30e-6, 30e-6);
  options.jitter = std::max(options.jitter, 1e-3);
  return options;
}

}  // namespace urban_nav_sim
