// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "icp/refine.hpp"
#include "urban_nav_registration/cloud/free_space.hpp"

namespace urban_nav_registration {

/// How much of two clouds' upright surfaces, laid upon each other, the beams of the other one went through.
struct SeenThrough {
  double confirmed = 0.0;     ///< pieces of the source on a surface of the target
  double contradicted = 0.0;  ///< pieces of both, half of each counted, where the other one saw nothing
  /// 0: no contradiction; 1: no agreement.
  double share() const { return contradicted / std::max(confirmed + contradicted, 1e-9); }
};
SeenThrough freeSpaceViolation(const std::vector<Surfel>& source, const std::vector<Surfel>& target,
                               const FreeSpace& of_source, const FreeSpace& of_target, const Refined& refined,
                               double inlier_distance);

}  // namespace urban_nav_registration
