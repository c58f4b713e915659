// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// Motion between two successive poses: T_from_to of the left camera, and its information, (rho, phi) in `from`. Zero
/// information is valid: the prediction is then only the initial estimate.
struct ProcessInput {
  urban_nav_core::Pose T_from_to;
  urban_nav_core::Matrix6d information = urban_nav_core::Matrix6d::Zero();
  std::optional<urban_nav_core::Pose> T_from_start =
      std::nullopt;  ///< initial estimate of the new pose, if not the prediction; not a measurement
};

/// Process model x_p(j+1) = f(x_p(j), u(j+1)) + w, w ~ N(0, Q) (Newman et al. 2009, section 2.1 and eq. 1): T_odom_next
/// = T_odom_last boxPlus(u, w). Q^-1 is the information of u plus floor(), so that a pose without measurements has a
/// valid covariance.
namespace process_model {

/// Information 1e-6 m^-2 and 0.1 rad^-2, a kilometre and three radians: the variances of free directions
/// (docs/conventions.md).
urban_nav_core::Matrix6d floor();

urban_nav_core::Pose predict(const urban_nav_core::Pose& T_odom_last, const ProcessInput& u);
/// Returns the initial estimate of the next pose.
urban_nav_core::Pose makeStart(const urban_nav_core::Pose& T_odom_last, const ProcessInput& u);

/// e = (T_odom_last^-1 T_odom_next) boxMinus u, zero where the prediction is exact, and its exact Jacobians by boxPlus
/// of either pose. e depends on the relative pose only, so the six gauge directions have no information.
struct Residual {
  urban_nav_core::Vector6d e;
  urban_nav_core::Matrix6d last;
  urban_nav_core::Matrix6d next;
};
Residual residual(const urban_nav_core::Pose& T_odom_last, const urban_nav_core::Pose& T_odom_next,
                  const urban_nav_core::Pose& u);

/// Returns e only.
urban_nav_core::Vector6d error(const urban_nav_core::Pose& T_odom_last, const urban_nav_core::Pose& T_odom_next,
                               const urban_nav_core::Pose& u);

}  // namespace process_model
}  // namespace swf_vo
