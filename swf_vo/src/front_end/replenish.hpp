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

/// Step (v) of section 2.4: new features, the best first by Harris score, where the quadtree has room; matched left to
/// right, refined, and started as tracks with their first observation.
class Replenisher {
 public:
  /// The camera must outlive it, and may learn its disparity offset. `features`: wanted in the image.
  Replenisher(const urban_nav_core::StereoCamera& camera, int features, double floor_px, bool subpixel = true);

  /// `matches`: those that are inliers keep their place. Appends to `fresh`. `rows`: by what the images differ, and
  /// what is seen of it.
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
  std::vector<PatchResidualTest> residual_test_;  // by level: noise is less further up
};

}  // namespace swf_vo
