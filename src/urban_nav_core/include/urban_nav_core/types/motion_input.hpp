// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// The command or measured motion u of the process model (Newman et al. 2009, section 2.1): how base_link moved between
/// two stamps. What the source does not observe (translation, for a gyroscope) has zero information.
struct MotionInput {
  StampNs from = 0;
  StampNs to = 0;
  Pose T_from_to;                           ///< of base_link
  Matrix6d information = Matrix6d::Zero();  ///< of (rho, phi) in `from`; may be singular
};

bool isApprox(const MotionInput& a, const MotionInput& b, double tolerance);
std::ostream& operator<<(std::ostream& out, const MotionInput& value);

}  // namespace urban_nav_core
