// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "noise/noise.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_sim/sensor.hpp"

namespace urban_nav_sim {

/// Errors of stamps.
struct ClockOptions {
  double offset = 0.0;  ///< s: stamp minus true time
  double skew = 0.0;    ///< s/s: the device clock runs faster by it from the start of the session
  double jitter = 0.0;  ///< s, standard deviation, truncated at three standard deviations
};

/// Converts true times to stamps. Stamps of one device increase strictly if they are more than 6 jitters apart.
class Clock {
 public:
  /// `begin`: the true stamp of t = 0.
  Clock(urban_nav_core::StampNs begin, const ClockOptions& options, const Noise& noise);

  /// Returns the true time as a stamp.
  urban_nav_core::StampNs taken(double t) const;
  /// Returns the stamp of measurement `k`, taken at t (s of the session).
  urban_nav_core::StampNs stamp(std::int64_t k, double t) const;

 private:
  urban_nav_core::StampNs begin_;
  ClockOptions options_;
  Noise noise_;
};

/// Returns the residual errors after drivers have corrected offset and skew of the device (docs/conventions.md): the
/// jitter of the lasers in the New College log, more if a device has no clock.
ClockOptions correctedClock(Sensor sensor);
/// Returns uncorrected errors: offsets of up to half a second, skews within the 30 ppm of a crystal (360 ppm for the
/// mirror of a laser), arrival over USB or a serial line. Drawn from `seed`.
ClockOptions uncorrectedClock(Sensor sensor, std::uint64_t seed);

}  // namespace urban_nav_sim
