// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "front_end/tracks.hpp"
#include "urban_nav_core/image/corner_grid.hpp"
#include "urban_nav_core/image/fast.hpp"
#include "urban_nav_core/image/pyramid.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace swf_vo {

/// Step (i) of Newman et al. 2009, section 2.4: pyramids and FAST corners of both images, with lookup by position.
class Corners {
 public:
  /// Corners at `levels` levels; the pyramids extend to level `top` for the estimation of the rotation between frames.
  /// `threshold`: initial FAST threshold, grey levels; adapted from frame to frame so that each level has a few corners
  /// for each of `features`.
  Corners(int levels, int top, int threshold, int features);

  /// Requires non-empty images.
  void extract(const urban_nav_core::StereoPair& pair);

  /// Number of levels with corners; fewer than requested for small images.
  int levels() const { return std::min(levels_, left_.pyramid.levels()); }
  /// Smallest level of the pyramids.
  int top() const { return std::min(top_, left_.pyramid.levels() - 1); }
  const urban_nav_core::ImageView& image(Side side, int level) const { return of(side).pyramid.level(level); }
  const urban_nav_core::CornerGrid& at(Side side, int level) const {
    return of(side).grids[static_cast<std::size_t>(level)];
  }
  int count(Side side) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  struct Eye {
    Eye(int pyramid_levels, int corner_levels)
        : pyramid(pyramid_levels),
          grids(static_cast<std::size_t>(corner_levels)),
          thresholds(static_cast<std::size_t>(corner_levels)) {}
    urban_nav_core::Pyramid pyramid;
    std::vector<urban_nav_core::CornerGrid> grids;
    std::vector<int> thresholds;
  };
  const Eye& of(Side side) const { return side == Side::Left ? left_ : right_; }
  void extract(const urban_nav_core::ImageView& image, Eye& eye);

  int levels_, top_, features_;
  urban_nav_core::Fast fast_;
  Eye left_, right_;
};

}  // namespace swf_vo
