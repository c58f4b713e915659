// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"
#include "urban_nav_registration/keyframe/keyframe.hpp"

namespace urban_nav_registration {

/// Extracts keyframes from stereo pairs. Corners are chosen as in swf_vo (Newman et al. 2009, section 2.4 (i) and (v)):
/// the best by Harris score first, as far as the quadtree has room, each with its disparity. Stateless: equal pairs
/// give equal bytes. Thread-safe.
class KeyframeExtractor {
 public:
  /// `points`: maximum number of points of a keyframe.
  KeyframeExtractor(const urban_nav_core::StereoCamera& camera, int points);

  /// Returns a keyframe without points if an image is missing or its size differs from that of the camera.
  Keyframe extract(const urban_nav_core::PoseRef& at, const urban_nav_core::StereoPair& pair) const;

 private:
  urban_nav_core::StereoCamera camera_;
  int points_;
};

}  // namespace urban_nav_registration
