// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Left-right matching of a new corner (Newman et al. 2009, section 2.4 (v)). Searches the row of the other image from
/// `lowest` to `highest` disparity (px of the given images). The best match must be better than any more than a few
/// pixels away, and the reverse search from it must return to the corner. `row_offset`, px: by how much the row in the
/// right image is further down. Returns the integer disparity; empty without a unique match. Pure; does not allocate.
std::optional<int> findDisparity(const ImageView& left, const ImageView& right, int u, int v, int lowest, int highest,
                                 int row_offset = 0);

}  // namespace urban_nav_core
