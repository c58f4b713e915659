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

class RightTurn;

/// Result of the front end for one stereo pair (Newman et al. 2009, section 2.4).
struct FrontEndResult {
  std::vector<Observation> tracked;  ///< tracked landmarks of the map, without outliers
  std::vector<Observation> fresh;    ///< first observations of new landmarks, with new ids
  std::vector<LandmarkId> ended;     ///< landmarks that are no longer tracked
  std::vector<LandmarkId>
      refuted;  ///< landmarks that move or were mismatched: their earlier measurements should be withdrawn as well
  urban_nav_core::Pose T_odom_camera;  ///< m-estimate over the matches; the prediction if there were too few
  bool localised = false;              ///< T_odom_camera is estimated from matches
  urban_nav_core::Pose T_odom_turned;  ///< the prediction, with the rotation estimated from this image and the previous
                                       ///< one
  bool turned = false;                 ///< that rotation was found
  int corners = 0;                     ///< FAST corners in the left image
  int candidates = 0;                  ///< matches before outlier rejection
  double inlier_share = 0.0;
  double reprojection_px = 0.0;  ///< root mean square of the inliers in the left image
  double row_offset_px = 0.0;    ///< RowOffset, current estimate
  double noise_scale = 1.0;      ///< NoiseScale::typical(), in standard deviations
  DisparityStep disparity_step;  ///< sigma 0: not measured
  RigConstants rig;              ///< RigRows and RightTurn, current estimate
};

/// Accuracy of a predicted pose.
struct PredictionQuality {
  bool astray = false;         ///< the prediction may be far off, because of the time since the previous frame
  double sigma_m = 0.0;        ///< standard deviation of the predicted translation
  double seconds = 0.0;        ///< since the previous frame
  bool is_turn_known = false;  ///< the rotation was measured by sensors and is more accurate than the rotation between
                               ///< the images
};

/// Returns the number of landmarks tracked at a time in images of this size, from the parameter `features`.
int featuresIn(const urban_nav_core::StereoCamera& camera, int features);

/// Converts images to observations, given a predicted pose. Independent of the window and of pose covariances.
class FrontEnd {
 public:
  /// `subpixel`: false rounds corners to whole pixels, for comparison.
  FrontEnd(const Parameters& parameters, const urban_nav_core::StereoCamera& camera, bool subpixel = true);
  ~FrontEnd();

  /// `predicted`: T_odom_camera of this frame by the process model; `last`: that of the previous frame as currently
  /// estimated by the window. `map`: landmarks of the window that are still tracked. `disparity_offset`: current
  /// estimate of the window (px). `quality`: of `predicted`; after frames that were not processed the prediction is
  /// treated as `astray` as well. `edges`: sharpness of the images. The result is valid until the next call.
  const FrontEndResult& process(FrameId frame, const urban_nav_core::StereoPair& pair, const urban_nav_core::Pose& last,
                                const urban_nav_core::Pose& predicted, const std::vector<MapPoint>& map,
                                double disparity_offset, const PredictionQuality& quality = {},
                                const Edges& edges = Edges());
  /// Returns the turn of the right camera, which may be corrected or suggested between frames.
  RightTurn& rightTurn();
  void archive(urban_nav_core::Archive& archive);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace swf_vo
