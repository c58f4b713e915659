// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_registration/keyframe/keyframe.hpp"
#include "urban_nav_registration/parameters.hpp"

namespace urban_nav_registration {

/// Reason for a rejected stereo closure. Values are stored: append new ones at the end.
enum class StereoReason {
  None = 0,          ///< accepted
  NoImage = 1,       ///< image missing, unreadable, or of another size than the camera's
  TooFewPoints = 2,  ///< too few corners with depth in an image
  NoConsensus = 3,   ///< no motion through three matches has enough inliers
  TooFewMatches = 4,
  LargeError = 5,     ///< mean reprojection error too large
  Unlike = 6,         ///< patches differ at the predicted positions: places are similar only in parts
  NotDetermined = 7,  ///< matches leave a direction undetermined
};
/// "none", "no_image", "too_few_points", "no_consensus", "too_few_matches", "large_error", "unlike", "not_determined".
const char* toString(StereoReason reason);

/// One condition of a verdict, with its measured value.
struct ClosureTest {
  std::string name;  ///< "matches", "reprojection_error_px", ...
  double value = 0.0, threshold = 0.0;
  bool at_least = true;  ///< value >= threshold is required, else value <= threshold
  bool passed = false;
};

/// Point matched in both left images.
struct MatchedPixels {
  Eigen::Vector2d in_a = Eigen::Vector2d::Zero(), in_b = Eigen::Vector2d::Zero();  ///< px
  double residual_px = 0.0;                                                        ///< reprojection error
  bool inlier = false;
};

/// Result of matching two keyframes.
struct StereoClosure {
  /// T_lefta_leftb: from the left optical frame of b to that of a. Zero information if rejected.
  urban_nav_core::Constraint lefts;
  urban_nav_core::ClosureVerdict verdict = urban_nav_core::ClosureVerdict::Rejected;
  StereoReason reason = StereoReason::NoImage;
  std::string sentence;  ///< explanation for the user

  int points_a = 0, points_b = 0;
  int putative = 0;              ///< matches by descriptor
  int consensus = 0;             ///< inliers of the best motion among these
  int visible = 0;               ///< points that should be visible in the other image, by the transform
  int matches = 0;               ///< points found by patch alignment and consistent, of these
  double likeness = 0.0;         ///< mean correlation of patches with the other image at the predicted positions
  double reprojection_px = 0.0;  ///< mean over the matches
  double noise_factor = 1.0;     ///< ratio of observed to predicted measurement error
  std::vector<ClosureTest> tests;
  std::vector<MatchedPixels> pixels;
};

/// Converts a constraint between left cameras to one between base_links, for cameras at T_base_left, which is assumed
/// to be exact.
urban_nav_core::Constraint betweenBases(const urban_nav_core::Constraint& lefts,
                                        const urban_nav_core::Pose& T_base_left);

/// Relative pose of two stereo keyframes (Newman et al. 2009, section 4.1): SIFT descriptors at a scale from the depth,
/// matched exhaustively; RANSAC on triples of 3D points; Gauss-Newton with a Huber kernel; then every point is searched
/// for in the other image, its patch warped by its surface and aligned with subpixel accuracy, and the motion is
/// estimated again. No prior on the motion.
///
/// The information comes from the matches with their measured residuals and one error common to all disparities
/// (Parameters). Equal keyframes give bit-identical results. Not thread-safe: caches the features of recent keyframes
/// by their PoseRef.
class StereoMatcher {
 public:
  StereoMatcher(const urban_nav_core::StereoCamera& camera, const Parameters& parameters);
  ~StereoMatcher();
  StereoMatcher(const StereoMatcher&) = delete;
  StereoMatcher& operator=(const StereoMatcher&) = delete;

  /// Matches two keyframes. Requires that two keyframes with equal `at` are equal.
  StereoClosure match(const Keyframe& a, const Keyframe& b);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace urban_nav_registration
