// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "edge_width.hpp"
#include "observation.hpp"
#include "swf_vo/parameters.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace swf_vo {

/// What the front end made of one stereo pair (Newman et al. 2009, section 2.4).
struct FrontEndResult {
  std::vector<Observation> tracked;  ///< of landmarks that were handed in, outliers removed
  std::vector<Observation> fresh;    ///< first observations of new landmarks, with new ids
  std::vector<LandmarkId> ended;     ///< landmarks that will not be looked for again
  std::vector<LandmarkId>
      refuted;  ///< landmarks that move or were matched wrongly: also earlier measurements should be withdrawn
  urban_nav_core::Pose T_odom_camera;  ///< by m-estimation over the matches; the prediction if there were too few
  bool localised = false;              ///< T_odom_camera comes from matches, not from the prediction
  urban_nav_core::Pose T_odom_turned;  ///< the prediction, turned as the images of this frame and the last one show
  bool turned = false;                 ///< they show how
  int corners = 0;                     ///< FAST corners in the left image
  int candidates = 0;                  ///< matches before outliers were removed
  double inlier_share = 0.0;
  double reprojection_px = 0.0;  ///< of the inliers, root mean square in the left image
  double row_offset_px = 0.0;    ///< RowOffset, as known by now
  double noise_scale = 1.0;      ///< NoiseScale::typical(), in standard deviations
  DisparityStep disparity_step;  ///< sigma 0 where nothing was compared
  RigConstants rig;              ///< RigRows and RightTurn, as known by now
};

/// What is known of a predicted pose.
struct PredictionQuality {
  bool astray = false;         ///< so much time has passed since the frame before that the prediction may be far off
  double sigma_m = 0.0;        ///< standard deviation of the predicted translation
  double seconds = 0.0;        ///< since the frame before
  bool is_turn_known = false;  ///< sensors measured the rotation: better than images of other places do
};

/// How many landmarks are followed at a time in images of this size, of the parameter `features`.
int featuresIn(const urban_nav_core::StereoCamera& camera, int features);

/// Images in, observations out: knows pixels and a predicted pose, no covariance of poses, no window.
class FrontEnd {
 public:
  /// `subpixel`: false places corners to whole pixels, for comparison.
  FrontEnd(const Parameters& parameters, const urban_nav_core::StereoCamera& camera, bool subpixel = true);
  ~FrontEnd();

  /// `predicted`: T_odom_camera of this frame by the process model; `last` that of the frame processed last, as the
  /// window has it now. `map`: the landmarks of the window that are still being followed. `disparity_offset`: of the
  /// camera, as the window has it now (px). `quality`: of `predicted`; frames that were left out here make it astray
  /// too. `edges`: how sharp the images are. The result lives until the next call.
  const FrontEndResult& process(FrameId frame, const urban_nav_core::StereoPair& pair, const urban_nav_core::Pose& last,
                                const urban_nav_core::Pose& predicted, const std::vector<MapPoint>& map,
                                double disparity_offset, const PredictionQuality& quality = {},
                                const Edges& edges = Edges());
  void archive(urban_nav_core::Archive& archive);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace swf_vo
