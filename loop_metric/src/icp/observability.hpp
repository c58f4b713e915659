// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "icp/normal_equations.hpp"

namespace loop_metric {

struct Observability {
  Matrix6d information = Matrix6d::Zero();  ///< (rho, phi) in the target frame; exactly zero along what is free
  Matrix6d covariance = Matrix6d::Zero();   ///< for display
  std::vector<Vector6d> free_directions;    ///< unit, in the same tangent
  double weakest = 0.0;  ///< deviation that laser_bias alone leaves in the weakest direction, m at the mean distance
};

/// What the matches say about each direction.
///
/// A noisy normal fakes information along a wall: its square adds up. Here a direction counts as held only as far as the normals of both clouds
/// agree: the mean of (J_source d)(J_target d), whose noise is independent and averages out, less twice its deviation over independent patches. And because
/// beams of one device err together (the range is off, the trajectory between the beams), no direction is known better than `laser_bias`
/// divided by that mean's root; where this exceeds `free_deviation` the direction is free.
Observability observe(const std::vector<Match>& matches, double sigma, double laser_bias, double free_deviation,
                      double patch);

}  // namespace loop_metric
