// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "laser_odometry/laser_odometry.hpp"
#include "registration.hpp"
#include "sweep_points.hpp"

namespace laser_odometry {

/// Returns the status of a sweep that begins the map.
urban_nav_core::Status statusOfStart(const SweepPoints& points, const Parameters& parameters, MotionSpace space);
/// Returns the status of a sweep that restarts the map: no motion was measured.
urban_nav_core::Status statusOfRestart(const SweepPoints& points, const Parameters& parameters, MotionSpace space);
/// Returns the status of a sweep whose reference time is not later than the previous one.
urban_nav_core::Status statusOfStamp(urban_nav_core::StampNs last, urban_nav_core::StampNs now);
/// Returns a Lost status if there are too few points for a registration.
std::optional<urban_nav_core::Status> findTooFewPoints(const SweepPoints& points, MotionSpace space);
/// Returns the status of a planar laser, which states that the motion is planar.
urban_nav_core::Status statusOfPlanar(urban_nav_core::Status status);
/// Returns the status of a sweep whose prior was left out. `contradiction`: of the prior; may be empty.
urban_nav_core::Status statusOfPrior(urban_nav_core::Status status, const std::string& contradiction);
/// Returns the status of a registration; the sentence names deficiencies.
urban_nav_core::Status statusOfRegistration(const Registration& registration, const SweepPoints& points,
                                            const Pose& T_odom_base, const Parameters& parameters);

/// Returns the status of a registration with an implausible motion: T_last_now as predicted and as registered.
urban_nav_core::Status statusOfJump(const Pose& predicted, const Pose& registered);

/// Returns a description of a free direction (scaled tangent in base_link): "along x", "about z", "along (0.7, 0.7,
/// 0.0)".
std::string describeDirection(const Vector6d& direction);

}  // namespace laser_odometry
