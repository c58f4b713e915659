// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/align.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "cloud/free_space.hpp"
#include "global/search.hpp"
#include "icp/judge.hpp"
#include "icp/misfit.hpp"
#include "icp/seen_through.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace loop_metric {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::PointCloud;

namespace {

constexpr std::size_t kFewPoints = 30;  // less is no cloud: a plane of 25 pieces cannot come of it
constexpr std::size_t kFewSurfaces = 25;
constexpr float kFreeCube = 2.0F;  // voxels: a beam's neighbours in the next scans go through the same cube

/// What clouds that were gathered by odometry tell beyond their surfaces.
struct Spaces {
  FreeSpace of_source, of_target;

  Spaces(const PointCloud& source, const PointCloud& target, float voxel)
      : of_source(source, kFreeCube * voxel), of_target(target, kFreeCube * voxel) {}
};

/// m: residuals that noise and bend make.
RobustScale explainedBy(const PointCloud& source, const PointCloud& target, double bend, float voxel) {
  const RobustScale a = noiseOf(source, voxel), b = noiseOf(target, voxel);
  return {std::max(std::hypot(a.all, b.all, bend), 1e-9), std::max(std::hypot(a.upright, b.upright, bend), 1e-9)};
}

/// Everything about the two clouds that does not depend on the pose.
struct Pair {
  const Surfels& source_surfels;
  const Surfels& target_surfels;
  Target target;
  Source source;
  const Parameters& parameters;
  const Possible& possible;
  std::optional<RobustScale> explained;  ///< where it is asked for
  std::optional<Spaces> spaces;     ///< of gathered clouds
};

struct Try {
  Refined refined;
  Fit fit;
};

Try tryFrom(const Pair& pair, const Pose& start, std::size_t first, std::size_t end) {
  Try made;
  made.refined = refine(pair.source, pair.target, start, first, end, pair.parameters.iterations);
  made.fit = fitOf(pair.source.steps()[end - 1], made.refined, pair.parameters);
  return made;
}

Observability observedOf(const Try& made, const Pair& pair) {
  const double bias = pair.spaces ? pair.explained->all : pair.parameters.laser_bias;
  return observedOf(made.refined, bias, static_cast<double>(pair.source_surfels.voxel), pair.parameters);
}

std::optional<Plausibility> plausibilityOf(const Try& made, const Pair& pair) {
  if (!pair.explained) return std::nullopt;
  const RobustScale spread = robustScaleOf(made.refined.matches);
  Plausibility plausibility;
  plausibility.misfit = spread.all / pair.explained->all;
  plausibility.upright_misfit = spread.upright / pair.explained->upright;
  if (pair.spaces)
    plausibility.seen_through = seenThrough(pair.source_surfels.all, pair.target_surfels.all, pair.spaces->of_source,
                                            pair.spaces->of_target, made.refined, pair.parameters.inlier_distance)
                                    .share();
  return plausibility;
}

bool isPossible(const Try& made, const Pair& pair) {
  const std::optional<Plausibility> plausibility = plausibilityOf(made, pair);
  if (plausibility && !isPlausible(*plausibility, pair.parameters)) return false;
  return !pair.possible || pair.possible({made.refined.T_target_source, observedOf(made, pair).information});
}

/// Can it be, give or take what a candidate may be off?
bool mayBe(const Pose& candidate, const Pair& pair) {
  if (!pair.possible) return true;
  urban_nav_core::Constraint rough;
  rough.T_a_b = candidate;
  rough.information.diagonal() << Vector3d::Constant(1.0), Vector3d::Constant(100.0);  // 1 m, 6 deg
  return pair.possible(rough);
}

Alignment judged(const Try& made, const Pair& pair, Alignment alignment, bool is_alone = false) {
  alignment.T_target_source = made.refined.T_target_source;
  alignment.iterations += made.refined.iterations;
  const Observability observed = observedOf(made, pair);
  std::optional<Plausibility> plausibility = plausibilityOf(made, pair);
  if (plausibility) plausibility->is_alone = is_alone;
  judge(made.fit, plausibility, made.refined, observed, pair.parameters, alignment);
  if (alignment.verdict != ClosureVerdict::Rejected && pair.possible &&
      !pair.possible({made.refined.T_target_source, observed.information}))
    reject(alignment, Reason::Impossible, "the surfaces fit, but at a pose that is known to be wrong");
  return alignment;
}

std::size_t surfacesOf(const Surfels& surfels) {
  return static_cast<std::size_t>(std::count_if(surfels.all.begin(), surfels.all.end(),
                                                [](const Surfel& surfel) { return surfel.planarity > 0.0F; }));
}

/// False, and the alignment rejected, where the clouds cannot be aligned at all.
bool checkClouds(const Surfels& source, const Surfels& target, Alignment& alignment) {
  const auto check = [&](const Surfels& surfels, const char* which) {
    if (surfels.points < kFewPoints) {
      reject(alignment, Reason::TooFewPoints,
             std::string("the ") + which + " holds " + std::to_string(surfels.points) + " points, at least " +
                 std::to_string(kFewPoints) + " are needed");
      return false;
    }
    const std::size_t surfaces = surfacesOf(surfels);
    if (surfaces < kFewSurfaces) {
      reject(alignment, Reason::NoSurfaces,
             std::string("the ") + which + " shows " + std::to_string(surfaces) + " pieces of surface, at least " +
                 std::to_string(kFewSurfaces) + " are needed");
      return false;
    }
    return true;
  };
  return check(source, "source") && check(target, "target");
}

bool areOne(const Pose& a, const Pose& b) { return distanceBetween(a, b) < 0.5 && angleBetween(a, b) < 0.09; }

/// Another place, not the same one further along a free direction.
bool isAnother(const Pose& pose, const Alignment& best) {
  constexpr double kFar = 50.0;  // squared deviations: six would be usual
  if (areOne(pose, best.T_target_source)) return false;
  if (best.verdict != ClosureVerdict::Degenerate) return true;
  const Vector6d d = boxMinus(pose, best.T_target_source);
  return d.dot(best.information * d) > kFar;
}

/// What a glance around found that might be as good as an answer that was found near the guess: usually nothing.
std::vector<Candidate> rivalsOf(const Alignment& local, const std::vector<Candidate>& candidates) {
  constexpr double kFar = 2.5, kTurned = 0.26;  // m, rad: what a coarse candidate may be off
  constexpr double kClearly = 0.85;             // of the answer's own score: below, it is not as good
  const auto isOwn = [&](const Candidate& candidate) {
    return distanceBetween(candidate.T_target_source, local.T_target_source) < kFar &&
           angleBetween(candidate.T_target_source, local.T_target_source) < kTurned;
  };
  double own = 0.0;
  for (const Candidate& candidate : candidates)
    if (isOwn(candidate)) own = std::max(own, candidate.score);
  std::vector<Candidate> others;
  for (const Candidate& candidate : candidates)
    if (!isOwn(candidate) && candidate.score > kClearly * own) others.push_back(candidate);
  return others;
}

/// The candidates that a coarse alignment leaves, aligned to the end: different from each other, none of them far behind the best.
std::vector<Try> triesOf(const Pair& pair, const std::vector<Candidate>& candidates) {
  constexpr double kFarBehind = 0.6;  // of the best score; max_second asks for more
  const std::size_t end = pair.source.steps().size(), from = end > 3 ? 1 : 0;
  std::vector<Try> coarse;
  for (const Candidate& candidate : candidates) {
    if (!mayBe(candidate.T_target_source, pair)) continue;
    coarse.push_back(tryFrom(pair, candidate.T_target_source, from, from + 1));
  }
  const auto better = [](const Try& a, const Try& b) { return a.fit.score() > b.fit.score(); };
  std::stable_sort(coarse.begin(), coarse.end(), better);
  std::vector<Try> tries;
  for (auto made = coarse.begin(); made != coarse.end(); ++made) {
    if (made->fit.score() < kFarBehind * coarse.front().fit.score()) break;
    const auto isSame = [&](const Try& other) {
      return areOne(made->refined.T_target_source, other.refined.T_target_source);
    };
    if (std::none_of(coarse.begin(), made, isSame))
      tries.push_back(tryFrom(pair, made->refined.T_target_source, from + 1, end));
  }
  return tries;
}

/// The best of the candidates, and how the best different one compares with it.
Alignment searched(const Pair& pair, const Pose& guess, Alignment alignment, const Try* first,
                   const std::vector<Candidate>& candidates) {
  constexpr double kNear = 0.7;  // of the answer's score: below, a rival is none, which allows for less to be shared
  std::vector<Try> tries = triesOf(pair, candidates);
  if (first != nullptr) tries.insert(tries.begin(), *first);
  if (tries.empty()) tries.push_back(tryFrom(pair, guess, 0, pair.source.steps().size()));
  std::stable_sort(tries.begin(), tries.end(),
                   [](const Try& a, const Try& b) { return a.fit.score() > b.fit.score(); });
  const auto possible = [&](const Try& made) { return isPossible(made, pair); };
  const auto found = std::find_if(tries.begin(), tries.end(), possible);
  if (found == tries.end()) {
    alignment = judged(tries.front(), pair, alignment);
    alignment.searched = true;
    if (alignment.verdict != ClosureVerdict::Rejected)
      reject(alignment, Reason::Impossible, "no pose that can be was found");
    return alignment;
  }
  const Alignment first_judged = judged(*found, pair, alignment);
  const auto second = std::find_if(found + 1, tries.end(), [&](const Try& made) {
    return isAnother(made.refined.T_target_source, first_judged) && possible(made);
  });
  const double share = second == tries.end() ? 0.0 : second->fit.score() / std::max(found->fit.score(), 1e-9);
  alignment = share < kNear ? judged(*found, pair, alignment, true) : first_judged;
  alignment.searched = true;
  if (second != tries.end()) alignment.rival = Rival{second->refined.T_target_source, share};
  alignment.tests.push_back(
      {"second_pose", share, pair.parameters.max_second, false, share <= pair.parameters.max_second});
  if (alignment.verdict != ClosureVerdict::Rejected && share > pair.parameters.max_second)
    reject(alignment, Reason::Ambiguous, "another, different pose fits as well");
  return alignment;
}

}  // namespace

Alignment align(const PointCloud& source, const PointCloud& target, const Parameters& parameters, const Pose& guess,
                Search search, const Known& known) {
  std::array<Surfels, 2> surfels;
  urban_nav_core::forEach(2, 1, [&](std::size_t i) {
    surfels[i] = makeSurfels(i == 0 ? source : target, static_cast<float>(parameters.voxel));
  });
  Alignment alignment;
  alignment.T_target_source = guess;
  alignment.source_points = surfels[0].points;
  alignment.source_left_out = surfels[0].left_out;
  alignment.target_points = surfels[1].points;
  alignment.target_left_out = surfels[1].left_out;
  if (!checkClouds(surfels[0], surfels[1], alignment)) return alignment;
  Target index(surfels[1], parameters.reach);
  Source steps(surfels[0], index);
  Pair pair{surfels[0], surfels[1], std::move(index), std::move(steps), parameters, known.possible, {}, {}};
  const auto voxel = static_cast<float>(parameters.voxel);
  if (known.bend && !source.origins.empty() && !target.origins.empty()) {
    pair.explained = explainedBy(source, target, *known.bend, voxel);
    pair.spaces.emplace(source, target, voxel);
  }
  const auto explain = [&] {
    if (!pair.explained) pair.explained = explainedBy(source, target, parameters.laser_bias, voxel);
  };
  const auto look = [&](const Vector3d& centre, const Grain& grain) {
    return searchGlobally(outlineOf(surfels[0], grain), outlineOf(surfels[1], grain), centre, parameters.search_radius,
                          grain);
  };
  if (search == Search::AtOnce) {
    explain();
    return searched(pair, guess, alignment, nullptr, look(guess.t(), kFine));
  }
  const Try first = tryFrom(pair, guess, 0, pair.source.steps().size());
  const Alignment local = judged(first, pair, alignment);
  if (search == Search::Never || local.verdict == ClosureVerdict::Degenerate) return local;
  const bool failed = local.verdict == ClosureVerdict::Rejected;
  const std::vector<Candidate> others = failed ? look(guess.t(), kFine) : rivalsOf(local, look(guess.t(), kCoarse));
  if (!failed && others.empty()) return local;
  explain();
  return searched(pair, guess, alignment, &first, others);
}

const char* toString(Reason reason) {
  switch (reason) {
    case Reason::None: return "";
    case Reason::TooFewPoints: return "too_few_points";
    case Reason::NoSurfaces: return "no_surfaces";
    case Reason::TooFewMatches: return "too_few_matches";
    case Reason::ResidualTooLarge: return "residual_too_large";
    case Reason::TooFewInliers: return "too_few_inliers";
    case Reason::NotConverged: return "not_converged";
    case Reason::Ambiguous: return "ambiguous";
    case Reason::Impossible: return "impossible";
    case Reason::Misfit: return "misfit";
    case Reason::SeenThrough: return "seen_through";
    case Reason::FreeDirections: break;
  }
  return "free_directions";
}

}  // namespace loop_metric
