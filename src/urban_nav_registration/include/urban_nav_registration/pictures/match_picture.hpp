// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_registration/keyframe/keyframe.hpp"
#include "urban_nav_registration/pictures/picture.hpp"
#include "urban_nav_registration/stereo/stereo_closure.hpp"

namespace urban_nav_registration {
/// Layout and colours of a picture of two matched views.
struct MatchPictureOptions {
  bool stacked = false;          ///< b below a; otherwise to its right
  int widest = 640;              ///< px, of one view: larger ones are reduced
  double worst_px = 0.5;         ///< residual at the red end of the colours, px
  int most_lines = 120;          ///< maximum number of inlier lines and of other lines; the ends of all inliers are
                                 ///< marked
  std::string title_a, title_b;  ///< shown in the corners of the views, such as session and time; ASCII
  std::string caption;           ///< shown below, such as StereoClosure::sentence; ASCII
};

/// Draws two keyframes with their matches (Newman et al. 2009, Figs. 12 and 13): inliers as lines from green (residual
/// zero) over yellow to red (`worst_px` and more), others as thin grey lines underneath. `pixels`: from StereoMatcher;
/// ignores those that are not finite or outside their image. A missing or unreadable image is shown as a labelled grey
/// panel. Thread-safe.
Picture drawMatches(const Keyframe& a, const Keyframe& b, const std::vector<MatchedPixels>& pixels,
                    const MatchPictureOptions& options = {});

}  // namespace urban_nav_registration
