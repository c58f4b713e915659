// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "icp/normal_equations.hpp"

namespace urban_nav_registration {

struct Observability {
  Matrix6d information = Matrix6d::Zero();  ///< (rho, phi) in the target frame; exactly zero along what is free
  Matrix6d covariance = Matrix6d::Zero();   ///< for display
  std::vector<Vector6d> free_directions;    ///< unit, in the same tangent; of planar scans those in the plane alone
  std::size_t held = 0;                     ///< number of directions that are not free
  double weakest = 0.0;  ///< deviation that `Doubt::bias` alone leaves in the weakest direction, m at the mean distance
};

/// How far clouds are to be believed, m.
struct Doubt {
  double bias = 0.0;            ///< what all of a cloud's points may be off together
  double most = 0.0;            ///< that a patch may be off as a whole, where residuals cannot tell
  double free_deviation = 0.0;  ///< a direction that `bias` moves by more than this is free
  /// Unit normal in the target frame of the plane of two planar scans, which measure nothing out of it.
  std::optional<Vector3d> scan_plane = {};
};

/// What the matches say about each direction.
///
/// A noisy normal fakes information along a wall: its square adds up. Here a direction counts as held only as far as
/// the normals of both clouds agree: the mean of (J_source d)(J_target d), whose noise is independent and averages out,
/// less twice its deviation over independent patches. And because beams of one device may err together (the range is
/// off, the trajectory between the beams), a direction that the bias divided by that mean's root moves by more than
/// `free_deviation` is free.
///
/// Of what is held, the information is that of patches of surface of `patch` m which err as wholes by what their
/// residuals show, each for itself and all together, at most by `most`: the points of a patch share its normal, its
/// beams and their odometry, so their number says nothing.
Observability observe(const std::vector<Match>& matches, double sigma, const Doubt& doubt, double patch);

}  // namespace urban_nav_registration
