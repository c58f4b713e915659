// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/corners.hpp"

namespace swf_vo {

using urban_nav_core::CornerQuota;
using urban_nav_core::Fast;
using urban_nav_core::ImageView;
using urban_nav_core::StereoPair;

namespace {

CornerQuota quota(int threshold) {
  CornerQuota made;
  made.threshold = threshold;
  return made;
}

}  // namespace

Corners::Corners(int levels, int top, int threshold)
    : levels_(levels),
      top_(std::max(top, levels - 1)),
      lowest_threshold_(std::max(3, threshold / 2)),
      cap_(quota(threshold)),
      left_(top_ + 1, levels),
      right_(top_ + 1, levels) {}

void Corners::extract(const StereoPair& pair) {
  extract(pair.left, left_);
  extract(pair.right, right_);
}

int Corners::count(Side side) const {
  std::size_t n = 0;
  for (int level = 0; level < levels(); ++level) n += at(side, level).size();
  return static_cast<int>(n);
}

void Corners::extract(const ImageView& image, Eye& eye) {
  eye.pyramid.build(image);
  for (int level = 0; level < std::min(levels_, eye.pyramid.levels()); ++level) {
    const ImageView& view = eye.pyramid.level(level);
    const auto& found = fast_.detect(view, lowest_threshold_, Fast::Suppression::LocalMaximum);
    kept_.assign(found.begin(), found.end());
    cap_.apply(kept_, view.width, view.height);
    eye.grids[static_cast<std::size_t>(level)].assign(kept_, view.width, view.height);
  }
}

}  // namespace swf_vo
