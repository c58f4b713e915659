// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Left-right matching of a corner seen for the first time (Newman et al. 2009, section 2.4 (v)): the row of the other
/// image is searched from `lowest` to `highest` disparity (px of the images handed in), the best must be better than
/// anything a few pixels away, and the search back from there must lead to the corner. `row_offset` (px): the row in
/// the right image is so much further down. Returns the whole-pixel disparity; empty where there is none, or no single
/// one. Pure; allocates nothing.
std::optional<int> findDisparity(const ImageView& left, const ImageView& right, int u, int v, int lowest, int highest,
                                 int row_offset = 0);

}  // namespace urban_nav_core
