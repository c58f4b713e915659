// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "front_end/corners.hpp"
#include "front_end/match.hpp"
#include "front_end/patch_residual_test.hpp"
#include "front_end/row_offset.hpp"
#include "front_end/tracks.hpp"
#include "observation.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/image/feature_quadtree.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// Step (v) of section 2.4: selects new features, the best by Harris score first, where the quadtree has room; matches
/// them from left to right, refines them, and starts tracks with their first observation.
class Replenisher {
 public:
  /// The camera must outlive this object; its disparity offset may change. `features`: wanted in the image.
  Replenisher(const urban_nav_core::StereoCamera& camera, int features, double floor_px, bool subpixel = true);

  /// `matches`: inliers occupy their positions. Appends to `fresh`. `rows`: row offset used, and updated with the new
  /// matches.
  void replenish(FrameId frame, const Corners& corners, const urban_nav_core::Pose& T_odom_camera,
                 const std::vector<Match>& matches, Tracks& tracks, std::vector<Observation>& fresh, RowOffset& rows);
  void archive(urban_nav_core::Archive& archive);

 private:
  struct Candidate {
    int level = 0, u = 0, v = 0;
    float score = 0.0F;
    bool of_clipped = false;
  };
  void gather(const Corners& corners);
  bool start(const Candidate& candidate, FrameId frame, const Corners& corners,
             const urban_nav_core::Pose& T_odom_camera, Tracks& tracks, std::vector<Observation>& fresh,
             RowOffset& rows);

  const urban_nav_core::StereoCamera& camera_;
  int features_;
  double floor_px_;
  bool subpixel_;
  urban_nav_core::FeatureQuadtree quadtree_;
  std::vector<Candidate> candidates_;
  std::vector<PatchResidualTest> residual_test_;  // one per level: noise decreases with the level
};

}  // namespace swf_vo
