// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "loop_metric/keyframe.hpp"
#include "loop_metric/parameters.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace loop_metric {

/// Why a pair of views gave no transform by stereo. Numbers are kept in stores: new ones go to the end.
enum class StereoReason {
  None = 0,          ///< accepted
  NoImage = 1,       ///< a view is missing, unreadable, or of another size than the camera's
  TooFewPoints = 2,  ///< too few corners with depth in a view
  NoConsensus = 3,   ///< no motion through three pairs of points explains enough of the others
  TooFewMatches = 4,
  LargeError = 5,     ///< mean reprojection error
  Unlike = 6,         ///< where points should be, the other view looks otherwise: places that are alike in parts
  NotDetermined = 7,  ///< matches leave a direction open beyond use
};
/// "none", "no_image", "too_few_points", "no_consensus", "too_few_matches", "large_error", "unlike", "not_determined".
const char* toString(StereoReason reason);

/// One condition of a verdict, with what was found.
struct ClosureTest {
  std::string name;  ///< "matches", "reprojection_error_px", ...
  double value = 0.0, threshold = 0.0;
  bool at_least = true;  ///< value >= threshold is wanted, else value <= threshold
  bool passed = false;
};

/// A point seen in both left images.
struct MatchedPixels {
  Eigen::Vector2d in_a = Eigen::Vector2d::Zero(), in_b = Eigen::Vector2d::Zero();  ///< px
  double residual_px = 0.0;  ///< distance from where the transform puts it
  bool inlier = false;
};

/// What two views say of each other.
struct StereoClosure {
  /// T_lefta_leftb: from the left optical frame of b to that of a. Information zero where the verdict is no.
  urban_nav_core::Constraint lefts;
  urban_nav_core::ClosureVerdict verdict = urban_nav_core::ClosureVerdict::Rejected;
  StereoReason reason = StereoReason::NoImage;
  std::string sentence;  ///< for a person

  int points_a = 0, points_b = 0;
  int putative = 0;              ///< pairs by descriptor
  int consensus = 0;             ///< of these, those that the best motion explains
  int visible = 0;               ///< points that the other view should show, by the transform
  int matches = 0;               ///< of these, those that were found by alignment and agree
  double likeness = 0.0;         ///< mean correlation of visible points' patches with what the other view shows there
  double reprojection_px = 0.0;  ///< mean over the matches
  double noise_factor = 1.0;     ///< of standard deviations: how much larger residuals are than alignments promise
  std::vector<ClosureTest> tests;
  std::vector<MatchedPixels> pixels;
};

/// The same as a constraint between base_link at both times, for a camera at T_base_left, which is taken as exact.
urban_nav_core::Constraint betweenBases(const urban_nav_core::Constraint& lefts,
                                        const urban_nav_core::Pose& T_base_left);

/// Pose recovery from two stereo pairs (Newman et al. 2009, section 4.1): SIFT descriptors of a size that depth gives, matched n to n; RANSAC on triples
/// of 3D points; Gauss-Newton with a Huber kernel; then every point is looked for in the other view at its place, its patch warped by its surface,
/// aligned to a fraction of a pixel, and the motion is estimated again. Nothing is assumed of the motion.
///
/// The information is that of the matches with their residuals as they are, with one error of all disparities in common (Parameters). The same keyframes
/// give the same bits, whatever came before. Not thread-safe: keeps what it made of the last keyframes, by their PoseRef.
class StereoMatcher {
 public:
  StereoMatcher(const urban_nav_core::StereoCamera& camera, const Parameters& parameters);
  ~StereoMatcher();
  StereoMatcher(const StereoMatcher&) = delete;
  StereoMatcher& operator=(const StereoMatcher&) = delete;

  /// Two keyframes with equal `at` must be equal.
  StereoClosure match(const Keyframe& a, const Keyframe& b);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace loop_metric
