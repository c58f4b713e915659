// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "topics/vo/vo_run.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav {

/// Draws the left image with its features (colour: disparity, red is near, blue is far; grey: rejected) and their
/// tracks over the previous frames. `features`: the newest frame last. Leaves frame, stamp and caption to the caller.
VoPicture drawTracks(const urban_nav_core::ImageView& image, const std::vector<std::vector<swf_vo::Feature>>& features);

}  // namespace urban_nav
