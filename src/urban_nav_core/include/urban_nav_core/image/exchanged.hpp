// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Detects exchanged left and right images of a rectified pair. Compares textured blocks along the rows at a quarter
/// of the resolution. Returns true where by far most disparities that are clear of zero have the wrong sign. Needs
/// some ten textured blocks, else returns false. Pure; allocates nothing.
bool looksExchanged(const ImageView& left, const ImageView& right);

}  // namespace urban_nav_core
