// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/icp/align.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "icp/alignment_validation.hpp"
#include "icp/free_space_violation.hpp"
#include "icp/residual_ratio.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_registration/cloud/free_space.hpp"
#include "urban_nav_registration/global/search.hpp"

namespace urban_nav_registration {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::PointCloud;

namespace {

constexpr std::size_t kFewPoints = 30;  // fewer points cannot give 25 surfels
constexpr std::size_t kFewSurfaces = 25;
constexpr double kAllHeadings = 3.14159265358979323846;
constexpr float kFreeCube = 2.0F;  // voxels: adjacent beams of the next scans pass through the same cube

/// Free space of local clouds.
struct Spaces {
  FreeSpace of_source, of_target;

  Spaces(const PointCloud& source, const PointCloud& target, float voxel)
      : of_source(source, kFreeCube * voxel), of_target(target, kFreeCube * voxel) {}
};

/// Returns the residuals expected from noise and deformation, m.
RobustScale explainedBy(const PointCloud& source, const PointCloud& target, double deformation_sigma, float voxel) {
  const RobustScale a = cloudNoise(source, voxel), b = cloudNoise(target, voxel);
  return {std::max(std::hypot(a.all, b.all, deformation_sigma), 1e-9),
          std::max(std::hypot(a.upright, b.upright, deformation_sigma), 1e-9)};
}

/// Data of the two clouds that do not depend on the pose.
struct Pair {
  const Surfels& source_surfels;
  const Surfels& target_surfels;
  Target target;
  Source source;
  const Parameters& parameters;
  const PosePredicate& is_possible;
  std::optional<RobustScale> explained;  ///< expected residuals, if required
  std::optional<Spaces> spaces;          ///< for local clouds
  bool is_planar = false;                ///< two planar scans, from files
};

/// Normal of the plane of planar scans in the target frame.
std::optional<Vector3d> scanPlane(const Pair& pair) {
  if (!pair.is_planar) return std::nullopt;
  return pair.target_surfels.scan_plane->cast<double>();
}

/// Returns the logarithm of the number of poses in the plane, a voxel apart, within a distance and an angle of a guess.
double countPoses(const Pair& pair, double radius, double turn) {
  double squares = 0.0;
  for (const Surfel& surfel : pair.source_surfels.all) squares += static_cast<double>(surfel.mean.squaredNorm());
  const double lever =
      std::sqrt(squares / static_cast<double>(std::max<std::size_t>(pair.source_surfels.all.size(), 1)));
  const double voxel = static_cast<double>(pair.source_surfels.voxel),
               cells = kAllHeadings * radius * radius / voxel / voxel;
  return std::log(std::max(cells * std::max(2.0 * turn * lever / voxel, 1.0), 1.0));
}

struct Try {
  Refined refined;
  Fit fit;
};

Try tryFrom(const Pair& pair, const Pose& start, std::size_t first, std::size_t end) {
  Try attempt;
  attempt.refined = refine(pair.source, pair.target, start, first, end, pair.parameters.iterations);
  attempt.fit = computeFit(pair.source.steps()[end - 1], attempt.refined, pair.parameters);
  return attempt;
}

Observability computeObservability(const Try& attempt, const Pair& pair) {
  const double bias = pair.spaces ? pair.explained->all : pair.parameters.laser_bias;
  return computeObservability(attempt.refined, bias, static_cast<double>(pair.source_surfels.voxel), pair.parameters,
                              scanPlane(pair));
}

std::optional<ValidationContext> validationContext(const Try& attempt, const Pair& pair) {
  if (!pair.explained) return std::nullopt;
  const RobustScale spread = computeResidualScale(attempt.refined.matches);
  ValidationContext plausibility;
  plausibility.misfit = spread.all / pair.explained->all;
  plausibility.upright_misfit = spread.upright / pair.explained->upright;
  if (pair.spaces)
    plausibility.seen_through =
        freeSpaceViolation(pair.source_surfels.all, pair.target_surfels.all, pair.spaces->of_source,
                           pair.spaces->of_target, attempt.refined, pair.parameters.inlier_distance)
            .share();
  return plausibility;
}

bool isPossible(const Try& attempt, const Pair& pair) {
  const std::optional<ValidationContext> plausibility = validationContext(attempt, pair);
  if (plausibility && !isPlausible(*plausibility, pair.parameters)) return false;
  return !pair.is_possible ||
         pair.is_possible({attempt.refined.T_target_source, computeObservability(attempt, pair).information});
}

/// Returns whether a candidate is possible within its accuracy.
bool mayBe(const Pose& candidate, const Pair& pair) {
  if (!pair.is_possible) return true;
  urban_nav_core::Constraint rough;
  rough.T_a_b = candidate;
  rough.information.diagonal() << Vector3d::Constant(1.0), Vector3d::Constant(100.0);  // 1 m, 6 deg
  return pair.is_possible(rough);
}

/// Returns the evidence of an alignment from a guess; its poses are limited by the maximum correspondence distance.
std::optional<PlanarEvidence> localEvidence(const Try& attempt, const Pair& pair) {
  if (!pair.is_planar) return std::nullopt;
  constexpr double kBasin = 0.5;  // rad
  return PlanarEvidence{computePlanarEvidence(attempt.fit, attempt.fit.score()),
                        countPoses(pair, pair.parameters.max_correspondence_distance, kBasin)};
}

/// Returns the evidence of the best pose of a search against the best different one, with score ratio `second`.
std::optional<PlanarEvidence> searchEvidence(const Try& attempt, double second, const Pair& pair) {
  if (!pair.is_planar) return std::nullopt;
  const double score = attempt.fit.score();
  return PlanarEvidence{computePlanarEvidence(attempt.fit, score) - computePlanarEvidence(attempt.fit, second * score),
                        countPoses(pair, pair.parameters.search_radius, kAllHeadings)};
}

Alignment judged(const Try& attempt, const Pair& pair, const std::optional<PlanarEvidence>& planar, Alignment alignment,
                 bool is_alone = false) {
  alignment.T_target_source = attempt.refined.T_target_source;
  alignment.iterations += attempt.refined.iterations;
  const Observability observed = computeObservability(attempt, pair);
  std::optional<ValidationContext> plausibility = validationContext(attempt, pair);
  if (plausibility) plausibility->is_alone = is_alone;
  judge(attempt.fit, plausibility, planar, attempt.refined, observed, pair.parameters, alignment);
  if (alignment.verdict != ClosureVerdict::Rejected && pair.is_possible &&
      !pair.is_possible({attempt.refined.T_target_source, observed.information}))
    reject(alignment, AlignmentReason::Impossible, "the surfaces fit, but the pose contradicts other information");
  return alignment;
}

std::size_t countSurfaces(const Surfels& surfels) {
  return static_cast<std::size_t>(std::count_if(surfels.all.begin(), surfels.all.end(),
                                                [](const Surfel& surfel) { return surfel.planarity > 0.0F; }));
}

/// Returns false, with the alignment rejected, if the clouds cannot be aligned.
bool checkClouds(const Surfels& source, const Surfels& target, Alignment& alignment) {
  const auto check = [&](const Surfels& surfels, const char* which) {
    if (surfels.points < kFewPoints) {
      reject(alignment, AlignmentReason::TooFewPoints,
             std::string("too few points in the ") + which + ": " + std::to_string(surfels.points) + ", at least " +
                 std::to_string(kFewPoints) + " required");
      return false;
    }
    const std::size_t surfaces = countSurfaces(surfels);
    if (surfaces < kFewSurfaces) {
      reject(alignment, AlignmentReason::NoSurfaces,
             std::string("too few surfaces in the ") + which + ": " + std::to_string(surfaces) + ", at least " +
                 std::to_string(kFewSurfaces) + " required");
      return false;
    }
    return true;
  };
  return check(source, "source") && check(target, "target");
}

bool areOne(const Pose& a, const Pose& b) { return distanceBetween(a, b) < 0.5 && angleBetween(a, b) < 0.09; }

/// Returns whether a pose is distinct from the best one, not only displaced along a free direction.
bool isAnother(const Pose& pose, const Alignment& best) {
  constexpr double kFar = 50.0;  // squared standard deviations; the expected value is six
  if (areOne(pose, best.T_target_source)) return false;
  if (best.verdict != ClosureVerdict::Degenerate) return true;
  const Vector6d d = boxMinus(pose, best.T_target_source);
  return d.dot(best.information * d) > kFar;
}

/// Returns candidates of the coarse search that may fit as well as the alignment from the guess; usually none.
std::vector<PoseCandidate> findRivals(const Alignment& local, const std::vector<PoseCandidate>& candidates) {
  constexpr double kFar = 2.5, kTurned = 0.26;  // m, rad: accuracy of a coarse candidate
  constexpr double kClearly = 0.85;             // of the score of the alignment: below, the fit is clearly worse
  const auto isOwn = [&](const PoseCandidate& candidate) {
    return distanceBetween(candidate.T_target_source, local.T_target_source) < kFar &&
           angleBetween(candidate.T_target_source, local.T_target_source) < kTurned;
  };
  double own = 0.0;
  for (const PoseCandidate& candidate : candidates)
    if (isOwn(candidate)) own = std::max(own, candidate.score);
  std::vector<PoseCandidate> others;
  for (const PoseCandidate& candidate : candidates)
    if (!isOwn(candidate) && candidate.score > kClearly * own) others.push_back(candidate);
  return others;
}

/// Returns distinct alignments of the candidates that remain after a coarse alignment, except for those with much lower
/// scores than the best.
std::vector<Try> listTries(const Pair& pair, const std::vector<PoseCandidate>& candidates) {
  constexpr double kFarBelow = 0.6;  // of the best score; max_second_best_ratio is higher
  const std::size_t end = pair.source.steps().size(), from = end > 3 ? 1 : 0;
  std::vector<Try> coarse;
  for (const PoseCandidate& candidate : candidates) {
    if (!mayBe(candidate.T_target_source, pair)) continue;
    coarse.push_back(tryFrom(pair, candidate.T_target_source, from, from + 1));
  }
  const auto better = [](const Try& a, const Try& b) { return a.fit.score() > b.fit.score(); };
  std::stable_sort(coarse.begin(), coarse.end(), better);
  std::vector<Try> tries;
  for (auto attempt = coarse.begin(); attempt != coarse.end(); ++attempt) {
    if (attempt->fit.score() < kFarBelow * coarse.front().fit.score()) break;
    const auto isSame = [&](const Try& other) {
      return areOne(attempt->refined.T_target_source, other.refined.T_target_source);
    };
    if (std::none_of(coarse.begin(), attempt, isSame))
      tries.push_back(tryFrom(pair, attempt->refined.T_target_source, from + 1, end));
  }
  return tries;
}

/// Returns the best alignment of the candidates, with the best distinct one as alternative.
Alignment searched(const Pair& pair, const Pose& guess, Alignment alignment, const Try* first,
                   const std::vector<PoseCandidate>& candidates) {
  constexpr double kNear = 0.7;  // of the score of the result: below, it is no alternative, including the loss of
                                 // overlap
  std::vector<Try> tries = listTries(pair, candidates);
  if (first != nullptr) tries.insert(tries.begin(), *first);
  if (tries.empty()) tries.push_back(tryFrom(pair, guess, 0, pair.source.steps().size()));
  std::stable_sort(tries.begin(), tries.end(),
                   [](const Try& a, const Try& b) { return a.fit.score() > b.fit.score(); });
  const auto is_possible = [&](const Try& attempt) { return isPossible(attempt, pair); };
  const auto found = std::find_if(tries.begin(), tries.end(), is_possible);
  if (found == tries.end()) {
    alignment = judged(tries.front(), pair, searchEvidence(tries.front(), 0.0, pair), alignment);
    alignment.searched = true;
    if (alignment.verdict != ClosureVerdict::Rejected)
      reject(alignment, AlignmentReason::Impossible, "no possible pose found");
    return alignment;
  }
  const Alignment first_validated = judged(*found, pair, std::nullopt, alignment);
  const auto second = std::find_if(found + 1, tries.end(), [&](const Try& attempt) {
    return isAnother(attempt.refined.T_target_source, first_validated) && is_possible(attempt);
  });
  const double share = second == tries.end() ? 0.0 : second->fit.score() / std::max(found->fit.score(), 1e-9);
  alignment = share < kNear || pair.is_planar
                  ? judged(*found, pair, searchEvidence(*found, share, pair), alignment, share < kNear)
                  : first_validated;
  alignment.searched = true;
  if (second != tries.end()) alignment.alternative = Alternative{second->refined.T_target_source, share};
  alignment.tests.push_back({"second_pose", share, pair.parameters.max_second_best_ratio, false,
                             share <= pair.parameters.max_second_best_ratio});
  if (alignment.verdict != ClosureVerdict::Rejected && share > pair.parameters.max_second_best_ratio)
    reject(alignment, AlignmentReason::Ambiguous, "ambiguous: a different pose fits as well");
  return alignment;
}

}  // namespace

Alignment align(const PointCloud& source, const PointCloud& target, const Parameters& parameters, const Pose& guess,
                SearchMode search, const AlignmentPrior& known) {
  std::array<Surfels, 2> surfels;
  urban_nav_core::forEach(2, 1, [&](std::size_t i) {
    surfels[i] = makeSurfels(i == 0 ? source : target, static_cast<float>(parameters.voxel_size));
  });
  Alignment alignment;
  alignment.T_target_source = guess;
  alignment.source_points = surfels[0].points;
  alignment.source_left_out = surfels[0].left_out;
  alignment.target_points = surfels[1].points;
  alignment.target_left_out = surfels[1].left_out;
  if (!checkClouds(surfels[0], surfels[1], alignment)) return alignment;
  Target index(surfels[1], parameters.max_correspondence_distance);
  Source steps(surfels[0], index);
  Pair pair{surfels[0], surfels[1], std::move(index), std::move(steps), parameters, known.is_possible, {}, {}, false};
  const auto voxel = static_cast<float>(parameters.voxel_size);
  if (known.deformation_sigma && !source.origins.empty() && !target.origins.empty()) {
    pair.explained = explainedBy(source, target, *known.deformation_sigma, voxel);
    pair.spaces.emplace(source, target, voxel);
  }
  pair.is_planar = !known.deformation_sigma && surfels[0].scan_plane && surfels[1].scan_plane;
  alignment.planar = pair.is_planar;
  const auto explain = [&] {
    if (!pair.explained) pair.explained = explainedBy(source, target, parameters.laser_bias, voxel);
  };
  const auto findCandidates = [&](const Vector3d& centre, const SearchResolution& grain) {
    return searchGlobally(extractVerticalStructure(surfels[0], grain), extractVerticalStructure(surfels[1], grain),
                          centre, parameters.search_radius, grain);
  };
  if (search == SearchMode::AtOnce) {
    explain();
    return searched(pair, guess, alignment, nullptr, findCandidates(guess.t(), kFineResolution));
  }
  const Try first = tryFrom(pair, guess, 0, pair.source.steps().size());
  const Alignment local = judged(first, pair, localEvidence(first, pair), alignment);
  if (search == SearchMode::Never || local.verdict == ClosureVerdict::Degenerate) return local;
  const bool failed = local.verdict == ClosureVerdict::Rejected;
  const std::vector<PoseCandidate> others = failed ? findCandidates(guess.t(), kFineResolution)
                                                   : findRivals(local, findCandidates(guess.t(), kCoarseResolution));
  if (!failed && others.empty()) return local;
  explain();
  return searched(pair, guess, alignment, &first, others);
}

const char* toString(AlignmentReason reason) {
  switch (reason) {
    case AlignmentReason::None: return "";
    case AlignmentReason::TooFewPoints: return "too_few_points";
    case AlignmentReason::NoSurfaces: return "no_surfaces";
    case AlignmentReason::TooFewMatches: return "too_few_matches";
    case AlignmentReason::ResidualTooLarge: return "residual_too_large";
    case AlignmentReason::TooFewInliers: return "too_few_inliers";
    case AlignmentReason::NotConverged: return "not_converged";
    case AlignmentReason::Ambiguous: return "ambiguous";
    case AlignmentReason::Impossible: return "impossible";
    case AlignmentReason::Misfit: return "misfit";
    case AlignmentReason::SeenThrough: return "seen_through";
    case AlignmentReason::FreeDirections: break;
  }
  return "free_directions";
}

}  // namespace urban_nav_registration
