// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "topics/vo/vo_run.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav {

/// The left image with its features (colour: disparity, so near is warm and far is cold; grey: not trusted) and the way
/// each came over the frames before. `features`: the newest frame last. Frame, stamp and caption are left to the
/// caller.
VoPicture drawTracks(const urban_nav_core::ImageView& image, const std::vector<std::vector<swf_vo::Feature>>& features);

}  // namespace urban_nav
