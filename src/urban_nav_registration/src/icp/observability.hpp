// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "icp/normal_equations.hpp"

namespace urban_nav_registration {

struct Observability {
  Matrix6d information = Matrix6d::Zero();  ///< (rho, phi) in the target frame; exactly zero along free directions
  Matrix6d covariance = Matrix6d::Zero();   ///< for display
  std::vector<Vector6d> free_directions;    ///< unit, in the same tangent; for planar scans only those in the plane
  std::size_t held = 0;                     ///< number of directions that are not free
  double weakest = 0.0;  ///< standard deviation due to `CloudErrors::bias` only, in the weakest direction, m at the
                         ///< mean distance
};

/// Error model of clouds, m.
struct CloudErrors {
  double bias = 0.0;            ///< error common to all points of a cloud
  double most = 0.0;            ///< limit of the error common to a patch, if residuals do not determine it
  double free_deviation = 0.0;  ///< a direction that `bias` displaces by more than this is free
  /// Unit normal in the target frame of the plane of two planar scans, which do not measure motions out of it.
  std::optional<Vector3d> scan_plane = {};
};

/// Computes the observability of each direction from the matches.
///
/// Noise of the normals creates spurious information along a wall, since its square accumulates. Here the information
/// of a direction is determined by the agreement of the normals of both clouds: the mean of (J_source d)(J_target d),
/// whose noise is independent and averages out, minus twice its standard deviation over independent patches. As beams
/// of one device may have a common error (range offset, trajectory between the beams), a direction is free if the bias
/// divided by the root of that mean exceeds `free_deviation`.
///
/// The information in the other directions is that of surface patches of `patch` m, each with a common error estimated
/// from the residuals, plus an error common to all patches, each limited to `most`: the points of a patch share its
/// normal, its beams and their odometry, so their number is not informative.
Observability observe(const std::vector<Match>& matches, double sigma, const CloudErrors& errors, double patch);

}  // namespace urban_nav_registration
