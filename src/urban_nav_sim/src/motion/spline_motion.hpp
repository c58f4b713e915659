// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "motion/motion.hpp"
#include "motion/time_spline.hpp"

namespace urban_nav_sim {

/// A motion whose six coordinates are one spline of time: position of the centre of the axle (x, y, z, m), then yaw,
/// pitch and roll (rad) of the body, R = Rz(yaw) Ry(pitch) Rx(roll). base_link is fixed to the body, one wheel radius
/// below the axle: it leaves the ground by less than 2 mm while the body leans by 7 deg. All members of MotionState are
/// exact derivatives.
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
