// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "motion/motion.hpp"
#include "proprioception/clock.hpp"
#include "proprioception/schedule.hpp"

namespace urban_nav_sim {

/// Errors of the odometry of a Segway RMP200.
struct WheelOptions {
  double scale_sigma = 0.005;        ///< of the radius of both wheels, constant in a session (tyre pressure, load)
  double difference_sigma = 0.0005;  ///< difference of scale between the wheels: 0.1 deg of heading per metre
  double track = 1.02;               ///< effective over nominal track: tyres scrub in turns
  double slip_sigma = 0.003;         ///< share of the travel of each wheel, correlated over about half a second
  bool counts = true;                ///< quantised to the counters of the base (Segway RMP interface guide)
  double largest_scale = 0.0;        ///< largest additional scale error of both wheels
};
WheelOptions perfectWheels();

/// Wheel odometry: planar pose in `odom`, which is base_link at t = 0, and speeds, every 36 ms. Immutable, so
/// thread-safe; the motion is not needed afterwards.
class Wheels {
 public:
  Wheels(const Motion& motion, const WheelOptions& options, const Clock& clock, const Noise& noise);

  /// Measurement k = 0 ... count() - 1, taken at sensorSchedule(Sensor::Wheels).at(k).
  const WheelMeasurement& at(std::int64_t k) const { return all_[static_cast<std::size_t>(k)]; }
  /// Scale of each wheel (measured over true), and its slip at a measurement as a share of its travel (positive: more
  /// is measured than driven).
  struct Errors {
    double left_scale = 1.0, right_scale = 1.0, slip_left = 0.0, slip_right = 0.0;
  };
  const Errors& errorsAt(std::int64_t k) const { return errors_[static_cast<std::size_t>(k)]; }
  std::int64_t count() const { return static_cast<std::int64_t>(all_.size()); }

 private:
  std::vector<WheelMeasurement> all_;
  std::vector<Errors> errors_;
};

}  // namespace urban_nav_sim
