// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// T_a_c = T_a_b (+) T_b_c with the Jacobians of boxPlus perturbations (Newman et al. 2009, eq. 11-15):
/// d_ac = J1 d_ab + J2 d_bc to first order, d_ab in a, d_bc in b, d_ac in a.
struct Composition {
  Pose T_a_c;
  Matrix6d J1;
  Matrix6d J2;
};
Composition compose(const Pose& T_a_b, const Pose& T_b_c);

/// T_b_a with J: d_ba (in b) = J d_ab (in a).
struct Inversion {
  Pose T_b_a;
  Matrix6d J;
};
Inversion invert(const Pose& T_a_b);

/// T_b_c = T_a_b^-1 T_a_c with both Jacobians: d_bc = J1 d_ab + J2 d_ac.
struct Between {
  Pose T_b_c;
  Matrix6d J1;
  Matrix6d J2;
};
Between between(const Pose& T_a_b, const Pose& T_a_c);

/// Composition, inverse and difference with covariances; errors of the two arguments are assumed independent.
PoseWithCovariance compose(const PoseWithCovariance& T_a_b, const PoseWithCovariance& T_b_c);
PoseWithCovariance invert(const PoseWithCovariance& T_a_b);

}  // namespace urban_nav_core
