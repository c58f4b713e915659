// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/keyframe/keyframe.hpp"

#include <cmath>

namespace urban_nav_registration {

namespace {

constexpr int kLargestStoredSize = 32767;  // px: positions are stored in 16 bits
constexpr int kMostLevels = 8;             // of a pyramid for that size

}  // namespace

void archive(urban_nav_core::Archive& archive, KeyframePoint& point) {
  archive(point.u, point.v, point.level, point.disparity, point.sigma_disparity, point.slope_u, point.slope_v);
}

void archive(urban_nav_core::Archive& archive, Keyframe& keyframe) {
  archive(keyframe.at.session, keyframe.at.stamp, keyframe.width, keyframe.height, keyframe.image, keyframe.points);
  if (!archive.isReading()) return;
  archive.require(keyframe.width >= 0 && keyframe.height >= 0 && keyframe.width <= kLargestStoredSize &&
                      keyframe.height <= kLargestStoredSize,
                  "image size out of range");
  for (const KeyframePoint& point : keyframe.points) {
    archive.require(point.level < kMostLevels, "pyramid level of a point out of range");
    archive.require(point.u >= 0 && point.v >= 0 && point.u << point.level < keyframe.width &&
                        point.v << point.level < keyframe.height,
                    "point outside the image");
    archive.require(std::abs(point.disparity) <= static_cast<float>(keyframe.width), "disparity out of range");
    archive.require(point.sigma_disparity > 0.0F, "standard deviation of a disparity is not positive");
  }
}

}  // namespace urban_nav_registration
