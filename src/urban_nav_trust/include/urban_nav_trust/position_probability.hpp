// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace urban_nav_trust {

/// Returns the probability that a normally distributed error is shorter than `radius` (m, positive). `covariance`: of
/// the error, m^2, positive semidefinite; a negative eigenvalue is replaced by 0. Exact to 1e-4. Returns 0 for a
/// covariance that is not finite.
double probabilityWithin(double radius, const Eigen::Matrix3d& covariance);

}  // namespace urban_nav_trust
