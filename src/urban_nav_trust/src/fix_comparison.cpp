// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/fix_comparison.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "urban_nav_core/geometry/level_motion.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"
#include "urban_nav_trust/covariance_scale.hpp"

namespace urban_nav_trust {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using urban_nav_core::formatNumber;
using urban_nav_core::secondsBetween;

namespace {

constexpr std::size_t kLeastParts = 3;     // two determine only one length
constexpr std::size_t kFixesOfGroup = 3;   // the median excludes an outlier
constexpr double kLongestGroup = 15.0;     // s
constexpr double kConsecutive = 5.0;       // s between fixes whose difference shows errors of GPS only
constexpr double kJumpByChance = 0.01;     // probability that noise alone makes a jump in a session
constexpr double kMedianDistance = 1.177;  // square root of the median of chi-square with two degrees of freedom
constexpr int kAlignments = 5;
// Relative error of horizontal distances in a map that may be tilted by 0.17 rad, as that of a robot without
// accelerometer (pose_graph): 1 - cos 0.17.
constexpr double kTiltedMap = 0.0145;

/// Errors of GPS shown by consecutive fixes.
struct FixErrors {
  double factor = 1.0;  ///< by which stated standard deviations are too small, at least 1
  double jump = 0.0;    ///< m, largest jump beyond the stated standard deviation; 0: none
};

/// Consecutive fixes.
using FixGroup = std::vector<const ComparedFix*>;

/// Measurement by a group of fixes.
struct FixPart {
  Interval interval;
  Vector2d by_map = Vector2d::Zero();   ///< mean position, m
  Vector2d excess = Vector2d::Zero();   ///< median of map minus GPS, m
  double variance = 1.0;                ///< m^2, of GPS on each axis
  Matrix2d by_path = Matrix2d::Zero();  ///< covariance of the position by the map, m^2
};

bool isSound(const ComparedFix& fix) {
  return fix.by_map.allFinite() && fix.by_gps.allFinite() && fix.covariance.allFinite() && fix.sigma.allFinite() &&
         fix.sigma.minCoeff() > 0.0;
}

double meanSigma(const ComparedFix& fix) { return fix.sigma.norm() * M_SQRT1_2; }

Vector2d mapMinusGps(const ComparedFix& fix, const urban_nav_core::LevelMotion& to_gps) {
  return (to_gps * Eigen::Vector3d(fix.by_map.x(), fix.by_map.y(), 0.0)).head<2>() - fix.by_gps;
}

FixErrors findErrors(const std::vector<ComparedFix>& fixes, const urban_nav_core::LevelMotion& to_gps) {
  FixErrors errors;
  std::vector<double> changes, relative;
  for (std::size_t i = 1; i < fixes.size(); ++i) {
    if (secondsBetween(fixes[i - 1].stamp, fixes[i].stamp) > kConsecutive) continue;
    changes.push_back((mapMinusGps(fixes[i], to_gps) - mapMinusGps(fixes[i - 1], to_gps)).norm());
    relative.push_back(changes.back() / std::hypot(meanSigma(fixes[i]), meanSigma(fixes[i - 1])));
  }
  if (changes.empty()) return errors;
  errors.factor = std::max(1.0, urban_nav_core::quantile(relative, 0.5) / kMedianDistance);
  // Squares are chi-square with two degrees of freedom, whose tail is exp(-x / 2).
  const double limit = std::sqrt(-2.0 * std::log(kJumpByChance / static_cast<double>(changes.size())));
  for (std::size_t i = 0; i < changes.size(); ++i)
    if (relative[i] > limit * errors.factor) errors.jump = std::max(errors.jump, changes[i]);
  return errors;
}

/// Returns the mean position of a group by the map, m.
Vector2d meanPlace(const FixGroup& group) {
  Vector2d mean = Vector2d::Zero();
  for (const ComparedFix* fix : group) mean += fix->by_map / static_cast<double>(group.size());
  return mean;
}

/// Returns groups of consecutive fixes in the middle half of each of `count` equal parts of the session: those furthest
/// from the groups chosen before, or from the mean position. They are chosen by the path, not by the fixes.
std::vector<FixGroup> chooseGroups(const std::vector<ComparedFix>& fixes, std::size_t count) {
  const double seconds = std::max(1e-9, secondsBetween(fixes.front().stamp, fixes.back().stamp));
  std::vector<std::vector<FixGroup>> candidates(count);
  Vector2d mean = Vector2d::Zero();
  for (std::size_t i = 0; i + kFixesOfGroup <= fixes.size(); ++i) {
    mean += fixes[i].by_map / static_cast<double>(fixes.size() + 1 - kFixesOfGroup);
    const double part = static_cast<double>(count) * secondsBetween(fixes.front().stamp, fixes[i].stamp) / seconds,
                 within = part - std::floor(part);
    if (within < 0.25 || within > 0.75 || part >= static_cast<double>(count)) continue;
    FixGroup group;
    for (std::size_t k = 0; k < kFixesOfGroup; ++k) group.push_back(&fixes[i + k]);
    if (secondsBetween(group.front()->stamp, group.back()->stamp) <= kLongestGroup)
      candidates[static_cast<std::size_t>(part)].push_back(std::move(group));
  }
  std::vector<FixGroup> chosen;
  std::vector<Vector2d> places;
  for (const std::vector<FixGroup>& part : candidates) {
    const auto distance = [&](const FixGroup& group) {
      const Vector2d place = meanPlace(group);
      double least = places.empty() ? (place - mean).norm() : HUGE_VAL;
      for (const Vector2d& other : places) least = std::min(least, (place - other).norm());
      return least;
    };
    const auto furthest = std::max_element(part.begin(), part.end(),
                                           [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    if (furthest == part.end()) continue;
    places.push_back(meanPlace(*furthest));
    chosen.push_back(*furthest);
  }
  return chosen;
}

/// Returns a bound of the largest eigenvalue of the correlation matrix of the groups, by their smallest distance in
/// time; 1 for three, where alignment absorbs what they have in common.
double correlationBound(const std::vector<FixGroup>& groups, double correlation) {
  if (groups.size() <= kLeastParts) return 1.0;
  double gap = HUGE_VAL;
  for (std::size_t i = 1; i < groups.size(); ++i)
    gap = std::min(gap, secondsBetween(groups[i - 1].front()->stamp, groups[i].front()->stamp));
  const double next = std::exp(-gap / correlation);
  return 1.0 + 2.0 * next / (1.0 - std::min(0.99, next));
}

/// Returns groups of fixes as measurements. `common`: correlationBound().
std::vector<FixPart> makeParts(const std::vector<FixGroup>& groups, const urban_nav_core::LevelMotion& to_gps,
                               double common, const FixErrors& errors) {
  std::vector<FixPart> parts;
  for (const FixGroup& group : groups) {
    FixPart part;
    part.interval = {group.front()->stamp, group.back()->stamp};
    part.by_map = meanPlace(group);
    part.by_path = group[group.size() / 2]->covariance;
    std::vector<double> x, y, sigmas;
    for (const ComparedFix* fix : group) {
      const Vector2d excess = mapMinusGps(*fix, to_gps);
      x.push_back(excess.x());
      y.push_back(excess.y());
      sigmas.push_back(meanSigma(*fix));
    }
    part.excess = {urban_nav_core::quantile(x, 0.5), urban_nav_core::quantile(y, 0.5)};
    const double sigma = errors.factor * urban_nav_core::quantile(sigmas, 0.5);
    part.variance = common * sigma * sigma + errors.jump * errors.jump;
    parts.push_back(part);
  }
  return parts;
}

/// Least squares over the parts for a level motion.
struct PartFit {
  double squares = 0.0;                      ///< minimum
  Eigen::Vector3d motion = {0.0, 0.0, 0.0};  ///< to be added to the alignment: turn about the mean position, shift
  Vector2d mean = Vector2d::Zero();          ///< aligned mean position, m
};

/// `scale`: factor of the standard deviations of the map's positions.
PartFit fitParts(const std::vector<FixPart>& parts, const urban_nav_core::LevelMotion& to_gps, double scale,
                 bool is_level) {
  std::vector<Vector2d> places;
  PartFit fit;
  for (const FixPart& part : parts) {
    places.push_back((to_gps * Eigen::Vector3d(part.by_map.x(), part.by_map.y(), 0.0)).head<2>());
    fit.mean += places.back() / static_cast<double>(parts.size());
  }
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(to_gps.yaw).toRotationMatrix();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Vector2d lever = places[i] - fit.mean;
    Matrix2d covariance = scale * scale * R * parts[i].by_path * R.transpose();
    covariance.diagonal().array() += parts[i].variance;
    if (!is_level) covariance.diagonal().array() += kTiltedMap * kTiltedMap * lever.squaredNorm();
    const Matrix2d weight = covariance.inverse();
    Eigen::Matrix<double, 2, 3> J;
    J << -lever.y(), 1.0, 0.0, lever.x(), 0.0, 1.0;
    information += J.transpose() * weight * J;
    right -= J.transpose() * weight * parts[i].excess;
    fit.squares += parts[i].excess.dot(weight * parts[i].excess);
  }
  information(0, 0) += 1e-12 * (1.0 + information(0, 0));  // a stationary robot has no direction
  fit.motion = information.ldlt().solve(right);
  fit.squares = std::max(0.0, fit.squares - right.dot(fit.motion));
  return fit;
}

urban_nav_core::LevelMotion alignAgain(const urban_nav_core::LevelMotion& to_gps, const PartFit& fit) {
  urban_nav_core::LevelMotion next;
  next.yaw = to_gps.yaw + fit.motion[0];
  const Eigen::Vector3d mean(fit.mean.x(), fit.mean.y(), 0.0);
  const Eigen::Vector3d from_mean = to_gps.shift - mean;
  next.shift = mean + Eigen::Vector3d(fit.motion[1], fit.motion[2], 0.0) +
               Eigen::AngleAxisd(fit.motion[0], Eigen::Vector3d::UnitZ()) * from_mean;
  return next;
}

urban_nav_core::LevelMotion alignAtFirst(const std::vector<ComparedFix>& fixes) {
  std::vector<Eigen::Vector3d> map, gps;
  std::vector<double> weights;
  for (const ComparedFix& fix : fixes) {
    map.emplace_back(fix.by_map.x(), fix.by_map.y(), 0.0);
    gps.emplace_back(fix.by_gps.x(), fix.by_gps.y(), 0.0);
    weights.push_back(1.0 / fix.sigma.squaredNorm());
  }
  return urban_nav_core::fitLevelMotion(map, gps, weights);
}

std::string explain(const FixErrors& errors, bool has_conflict) {
  if (errors.jump > 0.0)
    return " Fixes jump by up to " + formatNumber(errors.jump, 2) +
           " m from one to the next, which the path excludes: GPS is less accurate than it states (multipath).";
  if (!has_conflict) return "";
  return " Fixes follow each other without jumps, so that the path is implausible rather than GPS.";
}

/// Returns the parts between which the difference changes most.
Interval findConflict(const std::vector<FixPart>& parts) {
  std::size_t worst = 1;
  const auto change = [&](std::size_t i) { return (parts[i].excess - parts[i - 1].excess).norm(); };
  for (std::size_t i = 2; i < parts.size(); ++i)
    if (change(i) > change(worst)) worst = i;
  return {parts[worst - 1].interval.from, parts[worst].interval.to};
}

void addFixTest(const std::vector<ComparedFix>& fixes, const std::vector<FixPart>& parts,
                const urban_nav_core::LevelMotion& to_gps, const FixErrors& errors, bool is_level,
                TestResults& results) {
  constexpr double kNoConflict = 1e-3;  // p-value above which the sentence names no cause
  ConsistencyTest test;
  test.name = kFixTest;
  test.statistic = fitParts(parts, to_gps, 1.0, is_level).squares;
  test.degrees_of_freedom = 2.0 * static_cast<double>(parts.size()) - 3.0;
  double tail = 0.0;
  for (const double scale : covarianceScales())
    tail += 1.0 - urban_nav_core::chiSquareProbability(fitParts(parts, to_gps, scale, is_level).squares,
                                                       test.degrees_of_freedom);
  test.p_value = std::clamp(tail / static_cast<double>(kScaleCount), 0.0, 1.0);
  const bool has_conflict = test.p_value < kNoConflict;
  test.interval = has_conflict ? findConflict(parts) : Interval{fixes.front().stamp, fixes.back().stamp};
  double largest = 0.0, variance = 0.0;
  for (const FixPart& part : parts) {
    largest = std::max(largest, part.excess.norm());
    variance = std::max(variance, part.variance);
  }
  test.sentence = "The path and " + std::to_string(fixes.size()) + " GPS fixes differ at " +
                  std::to_string(parts.size()) + " compared places by up to " + formatNumber(largest) +
                  " m after alignment; a single fix has a standard deviation of " +
                  formatNumber(std::sqrt(variance), 2) + " m." + explain(errors, has_conflict);
  test.remedy =
      "The path in the map is bent or its scale is wrong, or the receiver states errors that are too small: compare "
      "both in `urban_nav export --gpkg`, and map with --set pose_graph.gps=true if GPS is right.";
  results.tests.push_back(std::move(test));
}

}  // namespace

void testFixes(const std::vector<ComparedFix>& fixes, const FixCircumstances& known, TestResults& results) {
  std::vector<ComparedFix> sound;
  std::copy_if(fixes.begin(), fixes.end(), std::back_inserter(sound), isSound);
  if (fixes.empty() || sound.size() < kLeastParts * kFixesOfGroup) {
    results.absent.push_back({kFixTest, fixes.empty() ? "no GPS fixes at poses of the path"
                                                      : "fewer than 9 GPS fixes at poses of the path"});
    return;
  }
  const double seconds = secondsBetween(sound.front().stamp, sound.back().stamp);
  const std::vector<FixGroup> groups =
      chooseGroups(sound, std::max(kLeastParts, static_cast<std::size_t>(seconds / (2.0 * known.correlation)) + 1));
  if (groups.size() < kLeastParts) {
    results.absent.push_back({kFixTest, "GPS fixes in less than three parts of the session"});
    return;
  }
  const double common = correlationBound(groups, known.correlation);
  urban_nav_core::LevelMotion to_gps = alignAtFirst(sound);
  FixErrors errors;
  std::vector<FixPart> parts;
  for (int i = 0; i < kAlignments; ++i) {
    errors = findErrors(sound, to_gps);
    parts = makeParts(groups, to_gps, common, errors);
    if (i + 1 < kAlignments) to_gps = alignAgain(to_gps, fitParts(parts, to_gps, 1.0, known.is_level));
  }
  addFixTest(sound, parts, to_gps, errors, known.is_level, results);
}

}  // namespace urban_nav_trust
