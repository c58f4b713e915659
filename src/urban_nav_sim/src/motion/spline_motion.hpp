// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "motion/motion.hpp"
#include "motion/time_spline.hpp"

namespace urban_nav_sim {

/// A motion whose six coordinates are one spline of time: place of the axle's middle (x, y, z, m), then yaw, pitch and
/// roll (rad) of the body, R = Rz(yaw) Ry(pitch) Rx(roll). base_link is fixed to the body, a wheel's radius below the
/// axle: it leaves the ground by under 2 mm while the body leans by 7 deg. Everything in MotionState is an exact
/// derivative.
class SplineMotion final : public Motion {
 public:
  SplineMotion(TimeSpline coordinates, double duration);

  double duration() const override { return duration_; }
  MotionState at(double t) const override;

 private:
  TimeSpline coordinates_;
  double duration_;
};

}  // namespace urban_nav_sim
