// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace loop_metric {

/// A point of a keyframe: a corner at a whole pixel of one pyramid level of the left image, and what the right image says of its depth.
struct KeyframePoint {
  std::int16_t u = 0, v = 0;             ///< px of its level
  std::uint8_t level = 0;                ///< of urban_nav_core::Pyramid
  float disparity = 0.0F;                ///< px of level 0
  float sigma_disparity = 1.0F;          ///< px of level 0
  float slope_u = 0.0F, slope_v = 0.0F;  ///< d(disparity)/d(u, v): how the surface leans

  /// Place in the left image, px of level 0.
  Eigen::Vector2d pixel() const { return {u << level, v << level}; }
};
void archive(urban_nav_core::Archive& archive, KeyframePoint& point);

/// What is kept of a stereo pair so that a later view can be registered to it (Newman et al. 2009, section 4.1): some 70 kB at 512x384, most of it the
/// picture. Plain data.
struct Keyframe {
  urban_nav_core::PoseRef at;
  std::vector<std::uint8_t> image;  ///< the left image as JPEG, grey; empty where it was missing
  int width = 0, height = 0;        ///< px
  std::vector<KeyframePoint> points;
};
/// As bytes for a store, and back: DataError where what is read is no keyframe (its image is looked at later, when it is used).
void archive(urban_nav_core::Archive& archive, Keyframe& keyframe);

/// Makes keyframes of stereo pairs: corners are chosen as those that swf_vo follows (section 2.4 (i) and (v)), the best first by Harris score where the
/// quadtree has room, each with its disparity. The same pair gives the same bytes, whatever came before. Thread-safe.
class KeyframeMaker {
 public:
  /// `points`: at most.
  KeyframeMaker(const urban_nav_core::StereoCamera& camera, int points);

  /// An image that is missing or of another size than the camera's: a keyframe without points.
  Keyframe make(const urban_nav_core::PoseRef& at, const urban_nav_core::StereoPair& pair) const;

 private:
  urban_nav_core::StereoCamera camera_;
  int points_;
};

}  // namespace loop_metric
