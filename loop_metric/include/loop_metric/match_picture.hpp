// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "loop_metric/keyframe.hpp"
#include "loop_metric/picture.hpp"
#include "loop_metric/stereo_closure.hpp"

namespace loop_metric {

struct MatchPictureOptions {
  bool stacked = false;          ///< b below a; else to its right
  int widest = 640;              ///< px, of one view: a larger one is reduced
  double worst_px = 0.5;         ///< residual at the red end of the colours, px
  int most_lines = 120;          ///< of either kind; ends are marked of all that agree
  std::string title_a, title_b;  ///< in the corners of the views, such as session and time; ASCII
  std::string caption;           ///< below, such as StereoClosure::sentence; ASCII
};

/// The two views with what was found in both (Newman et al. 2009, Figs. 12 and 13): matches as lines from green (residual zero) over yellow to red (`worst_px`
/// and more), what was looked for and did not agree as thin grey ones beneath. `pixels` as StereoMatcher gives them; those that are not finite or outside
/// their view are left out. A view whose image is missing or unreadable is a grey panel that says so. Thread-safe.
Picture drawMatches(const Keyframe& a, const Keyframe& b, const std::vector<MatchedPixels>& pixels,
                    const MatchPictureOptions& options = {});

}  // namespace loop_metric
