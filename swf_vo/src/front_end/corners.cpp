// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/corners.hpp"

namespace swf_vo {

using urban_nav_core::Fast;
using urban_nav_core::ImageView;
using urban_nav_core::StereoPair;

namespace {

// Target number of corners per feature at level 0; a quarter of that at each further level.
constexpr int kFewestPerFeature = 8, kMostPerFeature = 14;
constexpr int kLowestThreshold = 4, kHighestThreshold = 60;

}  // namespace

Corners::Corners(int levels, int top, int threshold, int features)
    : levels_(levels),
      top_(std::max(top, levels - 1)),
      features_(features),
      left_(top_ + 1, levels),
      right_(top_ + 1, levels) {
  for (Eye* eye : {&left_, &right_})
    std::fill(eye->thresholds.begin(), eye->thresholds.end(),
              std::clamp(threshold, kLowestThreshold, kHighestThreshold));
}

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
    int& threshold = eye.thresholds[static_cast<std::size_t>(level)];
    const auto& found = fast_.detect(view, threshold, Fast::Suppression::LocalMaximum);
    const int unit = std::max(1, features_ >> (2 * level)), count = static_cast<int>(found.size());
    if (count < kFewestPerFeature * unit) threshold = std::max(kLowestThreshold, threshold - 1 - threshold / 6);
    if (count > kMostPerFeature * unit) threshold = std::min(kHighestThreshold, threshold + 1 + threshold / 12);
    eye.grids[static_cast<std::size_t>(level)].assign(found, view.width, view.height);
  }
}

void Corners::archive(urban_nav_core::Archive& archive) {
  for (Eye* eye : {&left_, &right_})
    for (int& threshold : eye->thresholds) {
      archive(threshold);
      archive.require(threshold >= kLowestThreshold && threshold <= kHighestThreshold, "corner threshold out of range");
    }
}

}  // namespace swf_vo
