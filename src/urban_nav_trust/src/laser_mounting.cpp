// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/laser_mounting.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/sequence/change_detector.hpp"
#include "urban_nav_core/trajectory/normal_tail.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav_trust {

using urban_nav_core::ChangeDetector;
using urban_nav_core::formatNumber;
using urban_nav_core::normalTwoSidedTail;

namespace {

constexpr double kDegreesOfAngle = 180.0 / M_PI;
constexpr int kLeastLaserMatches = 30;       // of a laser in a keyframe
constexpr double kLeastLever = 0.5;          // m
constexpr int kAngleIterations = 5;          // of the reweighted estimate
constexpr double kAngleHuber = 1.5;          // standard deviations
constexpr double kLeastAngleScatter = 1e-3;  // m
// Errors common to the matches of a keyframe: surfaces are averages over cubes of 0.25 m with roughness, of which a
// tenth remains, at a lever of 2 m.
constexpr double kSurfaceFloor = 0.01;  // m
constexpr std::int64_t kLeastAngles = 8;
// Standard deviations of a measured mounting: angle (rad) and position (m) of laser and camera.
constexpr double kLaserTurnPrior = 0.01, kLaserShiftPrior = 0.02;
constexpr double kSameChange = 0.25;  // relative difference below which two lasers have turned by the same angle

/// Result for one laser.
struct Mounting {
  std::string name;
  int number = 0;
  ChangeDetector detector;
  double p_change = 1.0, p_level = 1.0, lever = 0.0;
  std::vector<ChangeDetector::Segment> segments;
  double level() const { return segments.front().mean; }
  bool hasChanged() const { return segments.size() > 1; }
  double change() const { return hasChanged() ? segments[1].mean - segments[0].mean : 0.0; }
};

Mounting assessLaser(const std::string& name, int number, const std::vector<LaserAngle>& angles, double false_alarm) {
  const auto count = static_cast<std::int64_t>(angles.size());
  Mounting mounting{name, number, ChangeDetector(false_alarm, count), 1.0, 1.0, 0.0, {}};
  for (const LaserAngle& each : angles) {
    mounting.detector.add({{each.stamp, each.stamp}, each.angle, each.sigma});
    mounting.lever += each.lever / static_cast<double>(count);
  }
  mounting.segments = mounting.detector.segments();
  mounting.p_change = urban_nav_core::changeProbability(mounting.detector.statistic(), count);
  const double stated = std::hypot(kLaserTurnPrior, kLaserShiftPrior / mounting.lever);
  if (!mounting.hasChanged())
    mounting.p_level = normalTwoSidedTail(mounting.level() / std::hypot(stated, mounting.segments.front().sigma));
  return mounting;
}

std::string printAngle(const ChangeDetector::Segment& segment) {
  return formatNumber(kDegreesOfAngle * segment.mean) + " deg (+-" + formatNumber(kDegreesOfAngle * segment.sigma, 2) +
         ")";
}

bool haveChangedTogether(const std::vector<Mounting>& mountings) {
  return mountings.size() > 1 && std::all_of(mountings.begin(), mountings.end(), [&](const Mounting& each) {
           return each.hasChanged() &&
                  std::abs(each.change() - mountings[0].change()) < kSameChange * std::abs(mountings[0].change());
         });
}

}  // namespace

std::vector<LaserAngle> laserAngles(const std::vector<KeyframeMatches>& keyframes, int laser) {
  std::vector<LaserAngle> angles;
  for (const KeyframeMatches& keyframe : keyframes) {
    std::vector<const SurfaceMatch*> matches;
    double levers = 0.0;
    for (const SurfaceMatch& match : keyframe.matches) {
      if (match.laser != laser || !std::isfinite(match.excess) || !std::isfinite(match.lever)) continue;
      matches.push_back(&match);
      levers += match.lever * match.lever;
    }
    if (matches.size() < kLeastLaserMatches) continue;
    const double lever = std::sqrt(levers / static_cast<double>(matches.size()));
    if (lever < kLeastLever) continue;
    double angle = 0.0, information = 0.0;
    for (int i = 0; i < kAngleIterations; ++i) {
      std::vector<double> sizes;
      for (const SurfaceMatch* match : matches) sizes.push_back(std::abs(match->excess + angle * match->lever));
      const double scatter = std::max(kLeastAngleScatter, 1.4826 * urban_nav_core::quantile(sizes, 0.5));
      double right = 0.0;
      information = 0.0;
      for (const SurfaceMatch* match : matches) {
        const double sigma = std::hypot(scatter, match->sigma);
        const double residual = std::abs(match->excess + angle * match->lever);
        const double weight = std::min(1.0, kAngleHuber * sigma / std::max(1e-12, residual)) / (sigma * sigma);
        information += weight * match->lever * match->lever;
        right -= weight * match->lever * match->excess;
      }
      angle = right / information;
    }
    if (std::isfinite(angle) && information > 0.0)
      angles.push_back({keyframe.stamp, angle, std::hypot(1.0 / std::sqrt(information), kSurfaceFloor / lever), lever});
  }
  return angles;
}

std::vector<int> testLaserMountings(const std::vector<KeyframeMatches>& keyframes,
                                    const std::vector<std::string>& lasers, double false_alarm,
                                    std::vector<ConsistencyTest>& tests, std::vector<AbsentMeasurement>& absent) {
  // Two questions about each laser: a change, and the constant (Bonferroni).
  const double questions = 2.0 * static_cast<double>(std::max<std::size_t>(1, lasers.size()));
  std::vector<Mounting> mountings;
  for (std::size_t i = 0; i < lasers.size(); ++i) {
    const std::vector<LaserAngle> angles = laserAngles(keyframes, static_cast<int>(i));
    if (static_cast<std::int64_t>(angles.size()) < kLeastAngles) continue;
    mountings.push_back(assessLaser(lasers[i], static_cast<int>(i), angles, false_alarm / questions));
  }
  if (mountings.empty()) {
    absent.push_back({kMountingTest, keyframes.empty() ? "no keyframes with stereo points and laser scans"
                                                       : "too few surfaces were measured by both stereo and a laser"});
    return {};
  }
  const auto smaller = [](const Mounting& each) { return std::min(each.p_change, each.p_level); };
  const Mounting& worst = *std::min_element(mountings.begin(), mountings.end(),
                                            [&](const auto& a, const auto& b) { return smaller(a) < smaller(b); });
  ConsistencyTest test;
  test.name = kMountingTest;
  test.statistic = worst.detector.statistic();
  test.degrees_of_freedom = static_cast<double>(worst.detector.measurements());
  test.p_value = std::min(1.0, questions * smaller(worst));
  test.interval = {worst.hasChanged() ? worst.segments[1].interval.from : worst.segments[0].interval.from,
                   worst.segments.back().interval.to};
  test.remedy =
      "The laser has turned on its mount, or its mounting in /tf_static is wrong: fasten it, and measure it again "
      "(`urban_nav map --calibrate` estimates it).";
  if (haveChangedTogether(mountings)) {
    test.sentence = "Surfaces by stereo have turned by " + formatNumber(kDegreesOfAngle * std::abs(worst.change())) +
                    " deg relative to those of all lasers.";
    test.remedy = "The stereo head has turned on its mount: fasten it and measure its mounting again (/tf_static).";
  } else if (worst.hasChanged()) {
    test.sentence = "The angle of " + worst.name + " in its scan plane, relative to surfaces by stereo, changed from " +
                    printAngle(worst.segments[0]) + " to " + printAngle(worst.segments[1]) + ".";
  } else {
    test.sentence = "The angle of " + worst.name + " in its scan plane, relative to surfaces by stereo, is " +
                    printAngle(worst.segments[0]) + " off its stated mounting in " +
                    std::to_string(worst.detector.measurements()) + " keyframes.";
  }
  tests.push_back(std::move(test));
  std::vector<int> turned;
  for (const Mounting& each : mountings)
    if (questions * smaller(each) < false_alarm) turned.push_back(each.number);
  return turned;
}

}  // namespace urban_nav_trust
