// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/image/view.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Two images of a rectified pair, 8-bit grey, of equal size: row v of the left is row v of the right.
/// The views do not own the pixels: they live as long as the caller says, at least through the call they are passed to.
/// An image that is missing (dropped, unreadable) is an empty view.
struct StereoPair {
  StampNs stamp = 0;
  ImageView left;
  ImageView right;
};

}  // namespace urban_nav_core
