// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/image/view.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Images of a rectified pair, 8-bit grey, of equal size: row v of the left is row v of the right. The views do not own
/// the pixels, which must be valid at least during the call that receives the pair. A missing image (dropped,
/// unreadable) is an empty view.
struct StereoPair {
  StampNs stamp = 0;
  ImageView left;
  ImageView right;
};

}  // namespace urban_nav_core
