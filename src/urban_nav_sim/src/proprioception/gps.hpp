// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "motion/motion.hpp"
#include "proprioception/clock.hpp"
#include "proprioception/geodesy.hpp"
#include "proprioception/random_walk.hpp"
#include "proprioception/schedule.hpp"

namespace urban_nav_sim {

/// Errors of a low-cost receiver among buildings. All zero: the measurement is exact.
struct GpsOptions {
  Geodetic origin = kOxford;     ///< origin of `world`, x east, y north
  double slow_sigma = 1.5;       ///< m per horizontal axis, over minutes: orbits, clocks, ionosphere; vertically twice
  double white_sigma = 0.3;      ///< m, from fix to fix
  double multipath_sigma = 4.0;  ///< m where half of the sky is hidden; correlated over about 20 s
  bool gaps = true;              ///< no fix where too little sky is visible: at one position in six
  double velocity_sigma = 0.08;  ///< m/s
};
GpsOptions perfectGps();

/// A receiver on the robot. Walls are not traced: the hidden share of the sky is a slowly varying function of position
/// (about 20 m), the same on every pass. Immutable, so thread-safe; the motion must outlive it.
class Gps {
 public:
  Gps(const Motion& motion, const urban_nav_core::Pose& T_base_gps, const GpsOptions& options, const Clock& clock,
      const Noise& noise);

  /// Fix k = 0, 1, ..., taken at sensorSchedule(Sensor::Gps).at(k). Without a fix the position is that of
  /// the last one (the origin before the first), the velocity zero and sigma 1 km.
  GpsMeasurement at(std::int64_t k) const;

 private:
  double hiddenSky(double t) const;
  bool hasFix(double t) const;
  GpsMeasurement fix(std::int64_t k) const;

  const Motion& motion_;
  urban_nav_core::Pose T_base_gps_;
  GpsOptions options_;
  Clock clock_;
  Schedule schedule_ = sensorSchedule(Sensor::Gps);
  Noise white_, sky_, multipath_;
  RandomWalk slow_;
};

}  // namespace urban_nav_sim
