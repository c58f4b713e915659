// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "window/marginalise.hpp"
#include "window/solve.hpp"

namespace swf_vo {

/// WARNING: covariances are first-order, at the linearisation points of the last factor, and as honest as the
/// measurements' own. All are of boxPlus in `odom`. A direction that nothing determines has the variance of
/// process_model::floor().
namespace covariance {

using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Of pose j were the disparity offset known.
urban_nav_core::Matrix6d givenOffset(const Solver& solver, std::size_t j);

/// Of pose j. `offset_variance`: of the disparity offset, px^2.
urban_nav_core::Matrix6d marginal(const Solver& solver, std::size_t j, double offset_variance);

/// Of poses j and j + 1 together.
Matrix12d joint(const Solver& solver, std::size_t j, double offset_variance);

/// Of the pose that left last, as it was when it left, together with the oldest pose as it is now. A settled estimate
/// does not move any more, and the newer one's error is independent of all that was measured: so the covariance between
/// both is that of the smoothed joint, gain P(b, oldest), with b the blocks of the prior, which are the first of the
/// factor. `left`: givenOffset of the one that left.
Matrix12d leftAndOldest(const Solver& solver, const urban_nav_core::Matrix6d& left, const Departed& departed,
                        double offset_variance);

/// Of T_a_b = T_odom_a^-1 T_odom_b, in a, from the joint covariance of both poses.
urban_nav_core::Matrix6d relative(const urban_nav_core::Pose& T_odom_a, const urban_nav_core::Pose& T_odom_b,
                                  const Matrix12d& joint);

/// Of T_odom_next = T_odom_last u, before it was measured: error propagation (Newman et al. 2009, section 2.2.1).
urban_nav_core::Matrix6d propagate(const urban_nav_core::Pose& T_odom_last, const urban_nav_core::Matrix6d& covariance,
                                   const ProcessInput& u);

}  // namespace covariance
}  // namespace swf_vo
