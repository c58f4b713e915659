// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "icp/refine.hpp"
#include "urban_nav_registration/cloud/free_space.hpp"

namespace urban_nav_registration {

/// Share of the vertical surfaces of two aligned clouds that beams of the other cloud passed through.
struct SeenThrough {
  double confirmed = 0.0;     ///< surfels of the source on a surface of the target
  double contradicted = 0.0;  ///< surfels of both in free space of the other, half of each counted
  /// 0: no contradiction; 1: no agreement.
  double share() const { return contradicted / std::max(confirmed + contradicted, 1e-9); }
};
SeenThrough freeSpaceViolation(const std::vector<Surfel>& source, const std::vector<Surfel>& target,
                               const FreeSpace& of_source, const FreeSpace& of_target, const Refined& refined,
                               double inlier_distance);

}  // namespace urban_nav_registration
