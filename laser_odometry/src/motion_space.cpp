// SPDX-License-Identifier: BSD-3-Clause
#include "motion_space.hpp"

#include <cmath>

namespace laser_odometry {

urban_nav_core::Pose toPlanar(const urban_nav_core::Pose& T) {
  const urban_nav_core::Matrix3d R = T.R();
  const double half = 0.5 * std::atan2(R(1, 0), R(0, 0));
  return {Eigen::Quaterniond(std::cos(half), 0.0, 0.0, std::sin(half)), {T.t().x(), T.t().y(), 0.0}};
}

urban_nav_core::Matrix6d toPlanar(const urban_nav_core::Matrix6d& covariance) {
  urban_nav_core::Matrix6d C = covariance;
  C.middleRows<3>(2).setZero();
  C.middleCols<3>(2).setZero();
  return C;
}

}  // namespace laser_odometry
