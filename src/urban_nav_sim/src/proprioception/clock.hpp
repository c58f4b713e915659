// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "noise/noise.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_sim/sensor.hpp"

namespace urban_nav_sim {

/// How far stamps are from the truth.
struct ClockOptions {
  double offset = 0.0;  ///< s: stamps are later by it
  double skew = 0.0;    ///< s/s: the device's clock runs faster by it, from the beginning of the session on
  double jitter = 0.0;  ///< s, standard deviation, cut at three of them
};

/// From true times to stamps. Stamps of one device increase strictly where they are apart by more than 6 jitters.
class Clock {
 public:
  /// `begin`: the true stamp of t = 0.
  Clock(urban_nav_core::StampNs begin, const ClockOptions& options, const Noise& noise);

  /// When it truly was.
  urban_nav_core::StampNs taken(double t) const;
  /// What measurement `k`, taken at t (s of the session), is stamped with.
  urban_nav_core::StampNs stamp(std::int64_t k, double t) const;

 private:
  urban_nav_core::StampNs begin_;
  ClockOptions options_;
  Noise noise_;
};

/// What drivers leave when they have corrected offset and skew of the device (docs/conventions.md): the jitter that the
/// New College log shows for its lasers, more where a device has no clock of its own.
ClockOptions correctedClock(Sensor sensor);
/// What they had to correct: offsets of up to half a second, skews within the 30 ppm of a crystal (360 ppm for the
/// mirror of a laser), arrival over USB or a serial line. Drawn from `seed`.
ClockOptions uncorrectedClock(Sensor sensor, std::uint64_t seed);

}  // namespace urban_nav_sim
