// SPDX-License-Identifier: BSD-3-Clause
#include "motion/spline_motion.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "motion/simulate_drive.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Matrix from the rates of (yaw, pitch, roll) to angular velocity in body axes, and its derivative.
struct RateMap {
  Matrix3d map, change;
};

RateMap rateMap(const Vector3d& angles, const Vector3d& rates) {
  const double sp = std::sin(angles[1]), cp = std::cos(angles[1]), sr = std::sin(angles[2]), cr = std::cos(angles[2]);
  const double p = rates[1], r = rates[2];
  RateMap m;
  m.map << -sp, 0.0, 1.0,  //
      cp * sr, cr, 0.0,    //
      cp * cr, -sr, 0.0;
  m.change << -cp * p, 0.0, 0.0,                 //
      -sp * p * sr + cp * cr * r, -sr * r, 0.0,  //
      -sp * p * cr - cp * sr * r, -cr * r, 0.0;
  return m;
}

}  // namespace

SplineMotion::SplineMotion(TimeSpline coordinates, double duration)
    : coordinates_(std::move(coordinates)), duration_(duration) {}

MotionState SplineMotion::at(double t) const {
  const TimeSpline::Value c = coordinates_.at(t);
  const Vector3d angles = c.value.tail<3>(), rates = c.rate.tail<3>();
  const Eigen::Quaterniond R_world_base = Eigen::AngleAxisd(angles[0], Vector3d::UnitZ()) *
                                          Eigen::AngleAxisd(angles[1], Vector3d::UnitY()) *
                                          Eigen::AngleAxisd(angles[2], Vector3d::UnitX());
  const RateMap m = rateMap(angles, rates);
  const Vector3d from_axle(0.0, 0.0, -kWheelRadius);

  MotionState motion_state;
  motion_state.rate_base = m.map * rates;
  motion_state.rate_change_base = m.map * c.change.tail<3>() + m.change * rates;
  const Vector3d& w = motion_state.rate_base;
  motion_state.T_world_base = urban_nav_core::Pose(R_world_base, c.value.head<3>() + R_world_base * from_axle);
  motion_state.velocity_world = c.rate.head<3>() + R_world_base * w.cross(from_axle);
  motion_state.acceleration_world =
      c.change.head<3>() +
      R_world_base * (motion_state.rate_change_base.cross(from_axle) + w.cross(w.cross(from_axle)));
  return motion_state;
}

}  // namespace urban_nav_sim
