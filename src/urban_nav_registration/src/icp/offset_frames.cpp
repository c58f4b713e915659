// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/icp/offset_frames.hpp"

#include "urban_nav_core/geometry/so3.hpp"

namespace urban_nav_registration {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

namespace {

Pose moved(const Pose& T, const CloudOffsets& offsets) {
  return Pose(T.q(), T.t() + offsets.target - T.q() * offsets.source);
}

}  // namespace

Pose relativeToOffsets(const Pose& T_target_source, const CloudOffsets& offsets) {
  return moved(T_target_source, {-offsets.source, -offsets.target});
}

Alignment toFileFrames(Alignment alignment, const CloudOffsets& offsets) {
  const urban_nav_core::Vector3d arm = alignment.T_target_source.q() * offsets.source;
  alignment.T_target_source = moved(alignment.T_target_source, offsets);
  if (alignment.alternative)
    alignment.alternative->T_target_source = moved(alignment.alternative->T_target_source, offsets);
  // t = t' + target - R source, and R = Exp(phi) R': rho = rho' + arm x phi.
  Matrix6d J = Matrix6d::Identity(), inverse = Matrix6d::Identity();
  J.topRightCorner<3, 3>() = urban_nav_core::skew(arm);
  inverse.topRightCorner<3, 3>() = -urban_nav_core::skew(arm);
  const Matrix6d covariance = J * alignment.covariance * J.transpose(),
                 information = inverse.transpose() * alignment.information * inverse;
  alignment.covariance = 0.5 * (covariance + covariance.transpose());
  alignment.information = 0.5 * (information + information.transpose());
  for (urban_nav_core::Vector6d& direction : alignment.free_directions) direction = (J * direction).normalized();
  return alignment;
}

}  // namespace urban_nav_registration
