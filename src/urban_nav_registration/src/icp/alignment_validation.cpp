// SPDX-License-Identifier: BSD-3-Clause
#include "icp/alignment_validation.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_registration {
using urban_nav_core::ClosureVerdict;

namespace {

constexpr double kFewUpright = 20.0;  // surfels: with fewer the share is not significant
constexpr double kUprightResidualFactor =
    2.5;  // times max_residual_ratio: voxels blur the edges of facades differently from each viewpoint
constexpr double kEnoughAlone =
    0.67;  // of min_vertical_inliers, without alternatives: of leaves and crowds a third coincides
constexpr double kStillMoving = 0.005;  // m in the last step
constexpr double kChanceShare = 0.1;    // of wall surfels at a wrong pose, before alignment; measured
constexpr double kPatchVoxels = 8.0;    // 2 m for 0.25 m: neighbours whose normals have no beam in common

struct Failure {
  AlignmentReason reason;
  const char* sentence;
};

std::string explainFree(std::size_t directions, bool planar) {
  return std::to_string(directions) + " of " +
         (planar ? "the three directions in the plane of the scans" : "six directions") +
         " are not constrained by the clouds";
}

}  // namespace

double Fit::score() const { return upright >= kFewUpright ? std::sqrt(inliers * upright_inliers) : inliers; }

Fit computeFit(const std::vector<Surfel>& source, const Refined& refined, const Parameters& parameters) {
  Fit fit;
  const Eigen::Vector3f level = (refined.T_target_source.R().transpose() * Vector3d::UnitZ()).cast<float>();
  double all = 0.0, upright_all = 0.0;
  for (std::size_t i = 0; i < source.size() && i < refined.matches.size(); ++i) {
    const Match& match = refined.matches[i];
    const double weight = static_cast<double>(source[i].planarity);
    const bool inlier = match.weight > 0.0 && std::abs(match.residual) < parameters.inlier_distance;
    const bool upright = std::abs(source[i].normal.dot(level)) < 0.5F;
    if (match.weight > 0.0) fit.matches += 1.0;
    all += weight;
    if (inlier) fit.inliers += weight;
    if (upright) {
      fit.upright += 1.0;
      upright_all += weight;
      if (inlier) fit.upright_inliers += weight;
    }
  }
  fit.inliers /= std::max(all, 1e-9);
  fit.upright_inliers /= std::max(upright_all, 1e-9);
  return fit;
}

Observability computeObservability(const Refined& refined, double bias, double voxel, const Parameters& parameters,
                                   const std::optional<Vector3d>& scan_plane) {
  const CloudErrors errors{bias, std::max(bias, parameters.laser_bias), parameters.free_deviation, scan_plane};
  return observe(refined.matches, std::max(refined.sigma, 1e-4), errors, kPatchVoxels * voxel);
}

double computePlanarEvidence(const Fit& fit, double share) {
  if (share <= kChanceShare) return 0.0;
  const double rest = 1.0 - share;
  return fit.matches *
         (share * std::log(share / kChanceShare) + (rest > 0.0 ? rest * std::log(rest / (1.0 - kChanceShare)) : 0.0));
}

void reject(Alignment& alignment, AlignmentReason reason, const std::string& sentence) {
  alignment.verdict = ClosureVerdict::Rejected;
  alignment.reason = reason;
  alignment.sentence = sentence;
  alignment.information.setZero();
  alignment.free_directions.clear();
  for (int i = 0; i < 6; ++i) alignment.free_directions.push_back(Vector6d::Unit(i));
  Vector6d unlimited;
  unlimited << Vector3d::Constant(1e6), Vector3d::Constant(10.0);
  alignment.covariance = unlimited.asDiagonal();
}

bool isPlausible(const ValidationContext& plausibility, const Parameters& parameters) {
  if (!plausibility.seen_through) return plausibility.misfit <= parameters.max_unmodelled_residual_ratio;
  return plausibility.misfit <= parameters.max_residual_ratio &&
         plausibility.upright_misfit <= kUprightResidualFactor * parameters.max_residual_ratio &&
         *plausibility.seen_through <= parameters.max_free_space_violation;
}

void judge(const Fit& fit, const std::optional<ValidationContext>& plausibility,
           const std::optional<PlanarEvidence>& planar, const Refined& refined, const Observability& observed,
           const Parameters& parameters, Alignment& alignment) {
  Failure failure{AlignmentReason::None, ""};
  const auto test = [&](const char* name, double value, double threshold, bool at_least, AlignmentReason reason,
                        const char* sentence) {
    const bool passed = at_least ? value >= threshold : value <= threshold;
    alignment.tests.push_back({name, value, threshold, at_least, passed});
    if (!passed && failure.reason == AlignmentReason::None) failure = {reason, sentence};
  };
  alignment.tests.clear();
  alignment.matches = static_cast<std::size_t>(fit.matches);
  test("matches", fit.matches, parameters.min_surfels, true, AlignmentReason::TooFewMatches,
       "too little overlap of the clouds");
  test("residual_m", refined.sigma, parameters.max_residual, false, AlignmentReason::ResidualTooLarge,
       "residuals of the surfaces are too large");
  const bool upright = fit.upright >= kFewUpright;
  if (plausibility && plausibility->seen_through) {
    test("misfit", plausibility->misfit, parameters.max_residual_ratio, false, AlignmentReason::Misfit,
         "residuals of the surfaces exceed noise and odometry drift");
    test("upright_misfit", plausibility->upright_misfit, kUprightResidualFactor * parameters.max_residual_ratio, false,
         AlignmentReason::Misfit, "residuals of the vertical surfaces exceed noise and odometry drift");
    test("seen_through", *plausibility->seen_through, parameters.max_free_space_violation, false,
         AlignmentReason::SeenThrough, "beams of one cloud passed through surfaces of the other");
    test("shared", upright ? fit.upright_inliers : fit.inliers, parameters.min_overlap, true,
         AlignmentReason::TooFewInliers, "too few of the surfaces coincide");
  } else {
    if (plausibility)
      test("misfit", plausibility->misfit, parameters.max_unmodelled_residual_ratio, false, AlignmentReason::Misfit,
           "residuals of the surfaces exceed the noise");
    const double enough = plausibility && plausibility->is_alone ? kEnoughAlone : 1.0;
    test("inliers", fit.inliers, parameters.min_inliers, true, AlignmentReason::TooFewInliers,
         "too few of the surfaces coincide");
    if (upright)
      test("upright_inliers", fit.upright_inliers, enough * parameters.min_vertical_inliers, true,
           AlignmentReason::TooFewInliers, "too few of the vertical surfaces coincide");
  }
  if (planar)
    test("planar_evidence", planar->evidence, planar->least, true, AlignmentReason::Ambiguous,
         "too few surfaces of planar scans coincide to exclude a different place");
  test("last_step_m", refined.usable ? refined.last_step : 1e3, kStillMoving, false, AlignmentReason::NotConverged,
       "the alignment did not converge");
  alignment.tests.push_back(
      {"weakest_direction_m", observed.weakest, parameters.free_deviation, false, observed.free_directions.empty()});
  if (failure.reason == AlignmentReason::None && observed.held < 2)
    failure = {AlignmentReason::TooFewMatches, "almost all directions are unconstrained"};
  if (failure.reason != AlignmentReason::None) {
    reject(alignment, failure.reason, failure.sentence);
    return;
  }
  alignment.information = observed.information;
  alignment.covariance = observed.covariance;
  alignment.free_directions = observed.free_directions;
  const bool free = !observed.free_directions.empty();
  alignment.verdict = free ? ClosureVerdict::Degenerate : ClosureVerdict::Accepted;
  alignment.reason = free ? AlignmentReason::FreeDirections : AlignmentReason::None;
  alignment.sentence = free ? explainFree(observed.free_directions.size(), planar.has_value()) : "";
}

}  // namespace urban_nav_registration
