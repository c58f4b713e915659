// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/stereo/stereo_closure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <list>

#include "stereo/described_keyframe.hpp"
#include "stereo/estimate.hpp"
#include "stereo/patch_alignment.hpp"
#include "stereo/ransac.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace urban_nav_registration {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Constraint;
using urban_nav_core::Matrix3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

namespace {

constexpr int kFewestAgreeing = 8;  // pairs; false motions usually have fewer inliers, and the others are rejected by
                                    // the patches
constexpr std::size_t kMostMotions = 4;
constexpr double kSufficientCorrelation =
    0.65;                              // bench, pairs: never reached by a wrong motion; ends the search for motions
constexpr double kMatchGate = 1.75;    // times the allowed mean error; larger residuals are outliers
constexpr std::size_t kKeptViews = 8;  // about 1 MB each at 512x384
constexpr int kLeastPoints = 20;       // with depth, in each view
// Limits for a transform; less accurate ones do not improve the graph.
constexpr double kLargestSigmaM = 1.0, kLargestSigmaRad = 0.1;

// Light displaces all edges consistently: shadows below ledges by millimetres, blur of the camera by some hundredths of
// a pixel. Bench pairs between days: the mean error of a hundred pairs is 0.03...0.09 px and 1...2 mm, in directions
// common to all pairs.
constexpr double kCommonPx = 0.06, kCommonM = 0.0015;

constexpr std::size_t kCoarseRounds = 2;
/// From the accuracy of the consensus, some pixels, to that of the patches.
constexpr std::array<AligningOptions, 4> kRounds = {AligningOptions{2, 3.0, 0.1}, AligningOptions{1, 3.0, 0.1},
                                                    AligningOptions{0, 2.0, 0.0}, AligningOptions{0, 1.5, 0.0}};

std::string stereoReason(const char* format, double value, double threshold) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, value, threshold);
  return text.data();
}

/// Returns the largest standard deviations of translation (m) and rotation (rad); infinite if undetermined.
std::array<double, 2> largestSigmas(const Matrix6d& information) {
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  const auto covariance = urban_nav_core::invertPositiveDefinite(information);
  if (!covariance) return {kNothing, kNothing};
  std::array<double, 2> sigmas{};
  for (const int half : {0, 1}) {
    const auto values = urban_nav_core::symmetricEigenvalues(covariance->block(3 * half, 3 * half, 3, 3));
    sigmas[static_cast<std::size_t>(half)] = values && (*values)[2] > 0.0 ? std::sqrt((*values)[2]) : kNothing;
  }
  return sigmas;
}

}  // namespace

const char* toString(StereoReason reason) {
  switch (reason) {
    case StereoReason::None: return "none";
    case StereoReason::NoImage: return "no_image";
    case StereoReason::TooFewPoints: return "too_few_points";
    case StereoReason::NoConsensus: return "no_consensus";
    case StereoReason::TooFewMatches: return "too_few_matches";
    case StereoReason::LargeError: return "large_error";
    case StereoReason::Unlike: return "unlike";
    case StereoReason::NotDetermined: return "not_determined";
  }
  return "none";
}

Constraint betweenBases(const Constraint& lefts, const Pose& T_base_left) {
  // T_basea_baseb = X T X^-1: with box perturbations phi' = Rx phi, rho' = Rx rho + [R' tx] phi'
  Constraint result;
  result.T_a_b = T_base_left * lefts.T_a_b * T_base_left.inverse();
  const Matrix3d Rx = T_base_left.R();
  Matrix6d left_by_base = Matrix6d::Zero();
  left_by_base.topLeftCorner<3, 3>() = left_by_base.bottomRightCorner<3, 3>() = Rx.transpose();
  left_by_base.topRightCorner<3, 3>() = -Rx.transpose() * urban_nav_core::skew(result.T_a_b.q() * T_base_left.t());
  result.information = left_by_base.transpose() * lefts.information * left_by_base;
  result.information = (0.5 * (result.information + result.information.transpose())).eval();
  return result;
}

class StereoMatcher::Implementation {
 public:
  Implementation(const StereoCamera& camera, const Parameters& parameters) : camera_(camera), parameters_(parameters) {}

  StereoClosure match(const Keyframe& keyframe_a, const Keyframe& keyframe_b) {
    const std::shared_ptr<const View> a = toView(keyframe_a), b = toView(keyframe_b);
    StereoClosure closure;
    closure.points_a = static_cast<int>(a->points.size());
    closure.points_b = static_cast<int>(b->points.size());
    if (!a->isReadable() || !b->isReadable())
      return refused(closure, StereoReason::NoImage,
                     std::string("image of ") + (a->isReadable() ? "the later" : "the earlier") +
                         " view is missing, unreadable or of another size");
    if (!test(closure, "points", std::min(closure.points_a, closure.points_b), kLeastPoints, true))
      return refused(closure, StereoReason::TooFewPoints,
                     stereoReason("too few points with depth in a view: %.0f, at least %.0f required",
                                  closure.tests.back().value, kLeastPoints));
    const std::vector<DescriptorMatch> pairs = mutualNearest(a->descriptors, b->descriptors);
    closure.putative = static_cast<int>(pairs.size());
    Refined best = findMotion(*a, *b, pairs, closure);
    if (!test(closure, "consensus", closure.consensus, kFewestAgreeing, true) || !best.found.found)
      return refused(closure, StereoReason::NoConsensus,
                     stereoReason("no consistent motion: at most %.0f of %.0f matches are inliers", closure.consensus,
                                  closure.putative));
    return refine(*a, *b, std::move(best), closure);
  }

 private:
  std::shared_ptr<const View> toView(const Keyframe& keyframe) {
    const auto known =
        std::find_if(views_.begin(), views_.end(), [&](const auto& view) { return view->at == keyframe.at; });
    if (known != views_.end()) {
      views_.splice(views_.begin(), views_, known);
      return views_.front();
    }
    views_.push_front(std::make_shared<const View>(keyframe, camera_));
    if (views_.size() > kKeptViews) views_.pop_back();
    return views_.front();
  }

  static bool test(StereoClosure& closure, const char* name, double value, double threshold, bool at_least) {
    const bool passed = at_least ? value >= threshold : value <= threshold;
    closure.tests.push_back({name, value, threshold, at_least, passed});
    return passed;
  }

  static StereoClosure refused(StereoClosure& closure, StereoReason reason, std::string sentence) {
    closure.verdict = ClosureVerdict::Rejected;
    closure.reason = reason;
    closure.sentence = std::move(sentence);
    closure.lefts.information.setZero();
    return closure;
  }

  struct Refined {
    Pose T_a_b;
    Estimate found;
    Aligned aligned;
    double worth() const { return found.inliers * aligned.likeness; }
  };

  /// Aligns all points and updates the motion; leaves it unchanged without a solution.
  void alignAndEstimate(const View& a, const View& b, AligningOptions round, Refined& refined) const {
    if (round.floor_px == 0.0) round.floor_px = parameters_.pixel_noise_floor;
    Aligned aligned = alignViews(camera_, a, b, refined.T_a_b, refined.found.offset, round);
    if (aligned.measurements.size() < 6) return;
    EstimateOptions options;
    options.sigma_offset = parameters_.disparity_offset;
    options.common_px = kCommonPx;
    options.common_m = kCommonM;
    options.largest_residual_px = kMatchGate * parameters_.max_reprojection_error;
    Estimate next = estimate(camera_, aligned.measurements, refined.T_a_b, options);
    if (!next.found) return;
    refined = {next.T_a_b, std::move(next), std::move(aligned)};
  }

  /// Tests several motions, since facades may be repetitive; the patches decide.
  Refined findMotion(const View& a, const View& b, std::vector<DescriptorMatch> pairs, StereoClosure& closure) const {
    Refined best;
    for (std::size_t tried = 0; tried < kMostMotions; ++tried) {
      Consensus motion = findConsensus(camera_, a, b, pairs);
      if (tried == 0) closure.consensus = motion.inliers;
      if (!motion.found) break;
      Refined its;
      its.T_a_b = motion.T_a_b;
      for (std::size_t round = 0; round < kCoarseRounds; ++round) alignAndEstimate(a, b, kRounds[round], its);
      if (its.worth() > best.worth()) {
        best = std::move(its);
        closure.consensus = motion.inliers;
      }
      if (best.aligned.likeness >= kSufficientCorrelation) break;
      pairs = std::move(motion.others);
    }
    return best;
  }

  StereoClosure refine(const View& a, const View& b, Refined refined, StereoClosure& closure) const {
    for (std::size_t round = kCoarseRounds; round < kRounds.size(); ++round)
      alignAndEstimate(a, b, kRounds[round], refined);
    const Estimate& found = refined.found;
    const Aligned& aligned = refined.aligned;
    closure.visible = aligned.visible;
    closure.likeness = aligned.likeness;
    closure.matches = found.inliers;
    closure.reprojection_px = found.reprojection_px;
    closure.noise_factor = found.noise_factor;
    closure.lefts.T_a_b = refined.T_a_b;
    for (std::size_t i = 0; i < found.measurements.size(); ++i) {
      const PointMeasurement& measurement = aligned.measurements[i];
      const Eigen::Vector2d own(camera_.left.fx * measurement.ray.x() + camera_.left.cx,
                                camera_.left.fy * measurement.ray.y() + camera_.left.cy);
      closure.pixels.push_back({measurement.of_a ? own : measurement.pixel, measurement.of_a ? measurement.pixel : own,
                                found.measurements[i].residual_px, found.measurements[i].inlier});
    }
    return judge(found, closure);
  }

  StereoClosure judge(const Estimate& found, StereoClosure& closure) const {
    const auto [sigma_m, sigma_rad] = largestSigmas(found.information);
    const bool enough = test(closure, "matches", closure.matches, parameters_.min_matches, true);
    const bool small =
        test(closure, "reprojection_error_px", closure.reprojection_px, parameters_.max_reprojection_error, false);
    const bool alike = test(closure, "likeness", closure.likeness, parameters_.min_patch_correlation, true);
    const bool firm = test(closure, "sigma_m", sigma_m, kLargestSigmaM, false);
    const bool turned = test(closure, "sigma_rad", sigma_rad, kLargestSigmaRad, false);
    if (!enough)
      return refused(
          closure, StereoReason::TooFewMatches,
          stereoReason("too few matches: %.0f, at least %.0f required", closure.matches, parameters_.min_matches));
    if (!small)
      return refused(closure, StereoReason::LargeError,
                     stereoReason("mean reprojection error too large: %.2f px, at most %.2f px allowed",
                                  closure.reprojection_px, parameters_.max_reprojection_error));
    if (!alike)
      return refused(
          closure, StereoReason::Unlike,
          stereoReason("patches differ at the predicted positions: mean correlation %.2f, at least %.2f required",
                       closure.likeness, parameters_.min_patch_correlation));
    if (!firm || !turned)
      return refused(closure, StereoReason::NotDetermined,
                     stereoReason("the transform is uncertain by %.2f m or %.3f rad", sigma_m, sigma_rad));
    closure.verdict = ClosureVerdict::Accepted;
    closure.reason = StereoReason::None;
    closure.sentence = stereoReason("%.0f matches with a mean reprojection error of %.3f px", closure.matches,
                                    closure.reprojection_px);
    closure.lefts.information = found.information;
    return closure;
  }

  StereoCamera camera_;
  Parameters parameters_;
  std::list<std::shared_ptr<const View>> views_;  // most recently used first
};

StereoMatcher::StereoMatcher(const StereoCamera& camera, const Parameters& parameters)
    : implementation_(std::make_unique<Implementation>(camera, parameters)) {}
StereoMatcher::~StereoMatcher() = default;

StereoClosure StereoMatcher::match(const Keyframe& a, const Keyframe& b) { return implementation_->match(a, b); }

}  // namespace urban_nav_registration
