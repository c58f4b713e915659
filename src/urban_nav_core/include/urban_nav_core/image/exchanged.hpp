// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Detects exchanged left and right images of a rectified pair, by comparing textured blocks along the rows at a
/// quarter of the resolution. Returns true if the great majority of disparities clearly different from zero have the
/// wrong sign. Returns false with fewer than about ten textured blocks. Pure; does not allocate.
bool looksExchanged(const ImageView& left, const ImageView& right);

}  // namespace urban_nav_core
