// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace laser_mapper {

/// Growth rate of the error that an odometry states along a session. Const functions are thread-safe.
class OdometryDrift {
 public:
  /// Adds the accumulating part of a step's covariance: its drift_covariance, or its covariance if the odometry does
  /// not provide the drift. `scale` multiplies it. A step that does not end later than the last one, or is not finite,
  /// is ignored.
  void add(const urban_nav_core::RelativePose& step, double scale = 1.0);

  /// Returns the covariance of (rho, phi) that a pose accumulates per second, m^2/s and rad^2/s, in the axes of
  /// base_link: mean over the steps that overlap `begin` ... `end`. Zero without steps, which means exact poses.
  urban_nav_core::Matrix6d rateDuring(urban_nav_core::StampNs begin, urban_nav_core::StampNs end) const;

 private:
  struct Step {
    urban_nav_core::StampNs from = 0, to = 0;
    double seconds = 0.0;                 ///< of all steps up to this one
    urban_nav_core::Matrix6d covariance;  ///< sum over all steps up to this one
  };
  std::vector<Step> steps_;
};

}  // namespace laser_mapper
