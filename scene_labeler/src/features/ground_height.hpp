// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "features/cube_moments.hpp"

namespace scene_labeler {

/// Heights around a return, m.
struct ColumnHeights {
  float over_ground = 0.0F;    ///< above the lower envelope of the cloud, which rises by at most 0.2 per m
  float over_lowest_1 = 0.0F;  ///< above the lowest return within 1 m of the vertical through the return
  float over_lowest_3 = 0.0F;  ///< within 3 m
  float below_highest = 0.0F;  ///< below the highest return within 1 m
  float column_extent = 0.0F;  ///< of the returns in the surrounding square of 0.5 m
  float filled = 0.0F;         ///< share of the cubes of 0.2 m between the lowest and the highest return of the square
};

/// Computes the heights around every cube of the level of 0.2 m.
std::vector<ColumnHeights> measureHeights(const CubeLevel& level);

}  // namespace scene_labeler
