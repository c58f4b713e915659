// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "window/marginalise.hpp"
#include "window/solve.hpp"

namespace swf_vo {

/// WARNING: covariances are first-order, at the linearisation points of the last factor, and only as good as those of
/// the measurements. Perturbation: boxPlus in `odom`. An unobserved direction has the variance of
/// process_model::floor().
namespace covariance {

using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Covariance of pose j, conditional on the disparity offset.
urban_nav_core::Matrix6d givenOffset(const Solver& solver, std::size_t j);

/// Covariance of pose j. `offset_variance`: of the disparity offset, px^2.
urban_nav_core::Matrix6d marginal(const Solver& solver, std::size_t j, double offset_variance);

/// Joint covariance of poses j and j + 1.
Matrix12d joint(const Solver& solver, std::size_t j, double offset_variance);

/// Joint covariance of the last marginalised pose, at the time of marginalisation, and the oldest pose of the window
/// now. A settled estimate is fixed, and the error of the newer one is independent of all that was measured: the cross
/// covariance is therefore that of the smoothed joint, gain P(b, oldest), with b the blocks of the prior, which come
/// first in the factor. `left`: givenOffset of the marginalised pose.
Matrix12d leftAndOldest(const Solver& solver, const urban_nav_core::Matrix6d& left, const Departed& departed,
                        double offset_variance);

/// Covariance of T_a_b = T_odom_a^-1 T_odom_b, in a, from the joint covariance of both poses.
urban_nav_core::Matrix6d relative(const urban_nav_core::Pose& T_odom_a, const urban_nav_core::Pose& T_odom_b,
                                  const Matrix12d& joint);

/// Covariance of T_odom_next = T_odom_last u before measurements: error propagation (Newman et al. 2009, section
/// 2.2.1).
urban_nav_core::Matrix6d propagate(const urban_nav_core::Pose& T_odom_last, const urban_nav_core::Matrix6d& covariance,
                                   const ProcessInput& u);

}  // namespace covariance
}  // namespace swf_vo
