// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/icp/align.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/testing/scanner.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;
using urban_nav_core::testing::courtyard;
using urban_nav_core::testing::Dice;
using urban_nav_core::testing::scan;
using urban_nav_core::testing::Scanner;
using urban_nav_core::testing::stand;
using urban_nav_core::testing::World;

constexpr double kDeg = 57.29577951308232;

void expectFinite(const Alignment& alignment) {
  EXPECT_TRUE(alignment.T_target_source.isFinite());
  EXPECT_TRUE(alignment.information.allFinite());
  EXPECT_TRUE(alignment.covariance.allFinite());
  for (const Vector6d& direction : alignment.free_directions) EXPECT_NEAR(direction.norm(), 1.0, 1e-9);
  for (const auto& test : alignment.tests) EXPECT_TRUE(std::isfinite(test.value)) << test.name;
}

/// Returns the squared Mahalanobis distance of the error in directions with information; expected 6 for six constrained
/// directions.
double squaredDeviations(const Alignment& alignment, const Pose& truth) {
  const Vector6d d = boxMinus(truth, alignment.T_target_source);
  return d.dot(alignment.information * d);
}

struct Pair {
  PointCloud source, target;
  Pose truth;
};

Pair makePair(const World& world, const Pose& T_world_source, const Pose& T_world_target, std::uint64_t seed) {
  return {scan(world, T_world_source, Scanner{}, 2 * seed + 1), scan(world, T_world_target, Scanner{}, 2 * seed + 2),
          T_world_target.inverse() * T_world_source};
}

TEST(Align, FindsSmallMotionsFromTheIdentity) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Pair pair = makePair(courtyard(seed), stand(1.0, 0.5, 5.0, 1.0, -2.0), stand(0.3, 0.1, 0.0), seed);
    const Alignment alignment = align(pair.source, pair.target, {});
    EXPECT_EQ(alignment.verdict, ClosureVerdict::Accepted) << seed << ": " << alignment.sentence;
    EXPECT_LT(distanceBetween(alignment.T_target_source, pair.truth), 0.02) << seed;
    EXPECT_LT(angleBetween(alignment.T_target_source, pair.truth) * kDeg, 0.1) << seed;
    EXPECT_LT(squaredDeviations(alignment, pair.truth), 22.5) << seed;
    expectFinite(alignment);
  }
}

TEST(Align, NeedsNoGuessWhateverTheHeading) {
  Dice dice(5);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Pose there = stand(dice.uniform(-3.0, 3.0), dice.uniform(-3.0, 3.0), dice.uniform(90.0, 270.0),
                             dice.uniform(-4.0, 4.0), dice.uniform(-4.0, 4.0));
    const Pair pair = makePair(courtyard(seed), there, stand(0.5, -0.5, 20.0), seed);
    for (const SearchMode search : {SearchMode::IfRejected, SearchMode::AtOnce}) {
      const Alignment alignment = align(pair.source, pair.target, {}, {}, search);
      EXPECT_EQ(alignment.verdict, ClosureVerdict::Accepted) << seed << ": " << alignment.sentence;
      EXPECT_LT(distanceBetween(alignment.T_target_source, pair.truth), 0.03) << seed;
      EXPECT_LT(angleBetween(alignment.T_target_source, pair.truth) * kDeg, 0.2) << seed;
    }
  }
}

TEST(Align, WhatIsKnownOfTheHeadingDecidesBetweenTwoThatFit) {
  // A closed box is symmetric.
  World box;
  for (int side = 0; side < 4; ++side) {
    const double heading = 0.5 * M_PI * side, away = side % 2 == 0 ? 8.0 : 12.0;
    box.blocks.push_back(
        {-away * std::sin(heading), away * std::cos(heading), side % 2 == 0 ? 24.0 : 16.0, 1.0, 0.0, 6.0, heading});
  }
  const Pair pair = makePair(box, stand(1.0, 0.5, 175.0), stand(-0.5, 0.3, 0.0), 1);
  const Alignment without = align(pair.source, pair.target, {}, {}, SearchMode::AtOnce);
  EXPECT_EQ(without.reason, AlignmentReason::Ambiguous) << without.sentence;
  ASSERT_TRUE(without.alternative);
  EXPECT_GT(without.alternative->share, 0.85);
  EXPECT_NEAR(angleBetween(without.alternative->T_target_source, without.T_target_source) * kDeg, 180.0, 2.0);
  int asked = 0;
  const auto near = [&](const Pose& pose) {
    return [&asked, pose](const urban_nav_core::Constraint& T) {
      ++asked;
      return angleBetween(T.T_a_b, pose) * kDeg < 30.0;
    };
  };
  const Pose turned = pair.truth * Pose(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ())), {});
  for (const SearchMode search : {SearchMode::AtOnce, SearchMode::IfRejected}) {
    const Alignment with = align(pair.source, pair.target, {}, {}, search, {near(pair.truth), {}});
    EXPECT_EQ(with.verdict, ClosureVerdict::Accepted) << with.sentence;
    EXPECT_LT(distanceBetween(with.T_target_source, pair.truth), 0.03);
    EXPECT_LT(angleBetween(with.T_target_source, pair.truth) * kDeg, 0.2);
    if (with.alternative) {
      EXPECT_LT(angleBetween(with.alternative->T_target_source, pair.truth) * kDeg, 30.0);
    }
    const Alignment other = align(pair.source, pair.target, {}, {}, search, {near(turned), {}});
    EXPECT_LT(angleBetween(other.T_target_source, turned) * kDeg, 2.0) << "it accepts its prior";
  }
  EXPECT_GT(asked, 0);
}

/// A court of 24 m by 20 m whose fronts have panels of up to half a metre depth: courts of different seeds differ only
/// in these panels.
World panelledCourt(std::uint64_t seed, double nearer = 0.0) {
  Dice dice(seed);
  World court;
  for (int side = 0; side < 4; ++side) {
    const double heading = 0.5 * M_PI * side, away = (side % 2 == 0 ? 10.0 : 12.0) - (side < 2 ? nearer : 0.0);
    const auto front = [&](double along, double out, double length, double top) {
      court.blocks.push_back({along * std::cos(heading) - out * std::sin(heading),
                              along * std::sin(heading) + out * std::cos(heading), length, 2.0, 0.0, top, heading});
    };
    front(0.0, away + 1.0, side % 2 == 0 ? 24.0 : 20.0, 6.0);
    if (side < 2) front(side == 0 ? 7.0 : -5.0, away - 1.5, 5.0, 6.0);  // breaks the symmetry of the sides
    for (double along = -9.0, step = 0.0; along < 9.0; along += step) {
      step = dice.uniform(1.0, 2.5);
      front(along + 0.5 * step, away + 1.0 - dice.uniform(0.05, 0.5), step, dice.uniform(5.0, 6.0));
    }
  }
  return court;
}

/// As makePair, with the sensor as origin of the beams.
Pair gatheredPair(const World& source, const World& target, std::uint64_t seed) {
  Pair pair = makePair(source, stand(1.0, 0.5, 5.0), stand(-0.5, 0.3, 0.0), seed);
  pair.target = makePair(target, stand(1.0, 0.5, 5.0), stand(-0.5, 0.3, 0.0), seed).target;
  for (PointCloud* cloud : {&pair.source, &pair.target})
    cloud->origins.assign(cloud->points.size(), Eigen::Vector3f::Zero());
  return pair;
}

TEST(Align, GatheredCloudsFitAsWellAsNoiseLetsThem) {
  AlignmentPrior known;
  known.deformation_sigma = 0.005;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Pair right = gatheredPair(panelledCourt(seed), panelledCourt(seed), seed),
               alike = gatheredPair(panelledCourt(seed), panelledCourt(seed + 50), seed);
    for (const SearchMode search : {SearchMode::IfRejected, SearchMode::AtOnce}) {
      const Alignment found = align(right.source, right.target, {}, {}, search, known);
      EXPECT_EQ(found.verdict, ClosureVerdict::Accepted) << found.sentence;
      EXPECT_LT(distanceBetween(found.T_target_source, right.truth), 0.02);
      EXPECT_LT(squaredDeviations(found, right.truth), 22.5);
      EXPECT_EQ(align(alike.source, alike.target, {}, {}, search).verdict, ClosureVerdict::Accepted)
          << "it tests nothing";
      const Alignment other = align(alike.source, alike.target, {}, {}, search, known);
      EXPECT_EQ(other.verdict, ClosureVerdict::Rejected);
      EXPECT_EQ(other.reason, AlignmentReason::Misfit) << other.sentence;
      expectFinite(other);
    }
  }
}

TEST(Align, WhatBeamsWentThroughIsNoWall) {
  AlignmentPrior known;
  known.deformation_sigma = 0.005;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Pair pair = gatheredPair(panelledCourt(seed, 4.0), panelledCourt(seed), seed);
    for (const bool swapped : {false, true}) {
      const Alignment alignment = swapped ? align(pair.target, pair.source, {}, {}, SearchMode::IfRejected, known)
                                          : align(pair.source, pair.target, {}, {}, SearchMode::IfRejected, known);
      EXPECT_EQ(alignment.verdict, ClosureVerdict::Rejected);
      EXPECT_EQ(alignment.reason, AlignmentReason::SeenThrough) << alignment.sentence;
    }
  }
}

/// Returns the part of a cloud visible to a sensor with a field of view of `half_deg` to both sides.
PointCloud ahead(const PointCloud& cloud, double half_deg) {
  PointCloud kept;
  for (const Eigen::Vector3f& point : cloud.points)
    if (std::abs(std::atan2(point.y(), point.x())) < half_deg / kDeg) kept.points.push_back(point);
  return kept;
}

TEST(Align, WhereNothingElseComesNearLessOfTheSurfacesWillDo) {
  int alone = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Pair pair = makePair(courtyard(seed), stand(1.0, 0.5, 5.0), stand(0.3, 0.1, 0.0), seed);
    pair.target = ahead(pair.target, 70.0);
    EXPECT_EQ(align(pair.source, pair.target, {}, {}, SearchMode::Never).reason, AlignmentReason::TooFewInliers)
        << "it tests nothing";
    const Alignment alignment = align(pair.source, pair.target, {});
    EXPECT_TRUE(alignment.searched);
    if (alignment.alternative && alignment.alternative->share > 0.7) {
      EXPECT_EQ(alignment.verdict, ClosureVerdict::Rejected);
      continue;
    }
    ++alone;
    EXPECT_EQ(alignment.verdict, ClosureVerdict::Accepted) << alignment.sentence;
    EXPECT_LT(distanceBetween(alignment.T_target_source, pair.truth), 0.02);
    EXPECT_LT(squaredDeviations(alignment, pair.truth), 22.5);
  }
  EXPECT_GE(alone, 2);
}

TEST(Align, WhatASearchFindsIsNoBetterThanNoiseLetsIt) {
  const PointCloud court = scan(panelledCourt(1), stand(1.0, 0.5, 5.0), {}, 1),
                   again = scan(panelledCourt(1), stand(-0.5, 0.3, 95.0), {}, 2),
                   alike = scan(panelledCourt(51), stand(-0.5, 0.3, 95.0), {}, 2);
  Parameters strict;  // the fronts differ by centimetres
  strict.laser_bias = 0.001;
  strict.max_unmodelled_residual_ratio = 1.25;
  EXPECT_EQ(align(court, again, strict, {}, SearchMode::AtOnce).verdict, ClosureVerdict::Accepted);
  EXPECT_EQ(align(court, alike, {}, {}, SearchMode::AtOnce).verdict, ClosureVerdict::Accepted) << "it tests nothing";
  const Alignment alignment = align(court, alike, strict, {}, SearchMode::AtOnce);
  EXPECT_EQ(alignment.verdict, ClosureVerdict::Rejected);
  EXPECT_EQ(alignment.reason, AlignmentReason::Misfit) << alignment.sentence;
  expectFinite(alignment);
}

TEST(Align, ReportsThatNoPoseIsPossible) {
  const Pair pair = makePair(courtyard(1), stand(1.0, 0.5, 5.0), stand(0.3, 0.1, 0.0), 1);
  const auto never = [](const urban_nav_core::Constraint&) { return false; };
  for (const SearchMode search : {SearchMode::Never, SearchMode::IfRejected, SearchMode::AtOnce}) {
    const Alignment alignment = align(pair.source, pair.target, {}, {}, search, {never, {}});
    EXPECT_EQ(alignment.reason, AlignmentReason::Impossible);
    EXPECT_EQ(alignment.information, Matrix6d::Zero());
    expectFinite(alignment);
  }
}

TEST(Align, NeverTakesOnePlaceForAnother) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const PointCloud source = scan(courtyard(seed), stand(0.0, 0.0, 0.0), {}, 1),
                     target = scan(courtyard(seed + 100), stand(0.0, 0.0, 0.0), {}, 2);
    EXPECT_EQ(align(source, target, {}).verdict, ClosureVerdict::Rejected) << seed;
  }
}

/// A planar laser with a horizontal scan.
PointCloud scanLevel(const World& world, const Pose& T_world_sensor, std::uint64_t seed) {
  Scanner scanner;
  scanner.rings = 1;
  scanner.beams = 720;
  scanner.lowest = scanner.highest = 0.0;
  return scan(world, T_world_sensor, scanner, seed);
}

TEST(Align, PlanarScansThatAreHeldInTheirPlaneAreAccepted) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const SearchMode search : {SearchMode::IfRejected, SearchMode::AtOnce}) {
      const Pose T_world_source = stand(1.0, 0.5, 5.0), T_world_target = stand(0.3, 0.1, 0.0);
      const Alignment alignment = align(scanLevel(courtyard(seed), T_world_source, 2 * seed),
                                        scanLevel(courtyard(seed), T_world_target, 2 * seed + 1), {}, {}, search);
      const Pose truth = T_world_target.inverse() * T_world_source;
      EXPECT_EQ(alignment.verdict, ClosureVerdict::Accepted) << seed << ": " << alignment.sentence;
      EXPECT_TRUE(alignment.planar);
      EXPECT_TRUE(alignment.free_directions.empty());
      EXPECT_LT(distanceBetween(alignment.T_target_source, truth), 0.03) << seed;
      EXPECT_LT(squaredDeviations(alignment, truth), 22.5);
      for (const int i : {2, 3, 4}) {
        EXPECT_LT(alignment.information.col(i).norm(), 1e-9 * alignment.information.norm()) << "not measured";
        EXPECT_GT(alignment.covariance(i, i), 1.0);
      }
      for (const int i : {0, 1, 5}) EXPECT_GT(alignment.information(i, i), 100.0) << i;
      expectFinite(alignment);
    }
}

TEST(Align, PlanarScansOfACorridorSlideInTheirPlane) {
  World corridor;
  corridor.blocks = {{0.0, 3.0, 200.0, 1.0, 0.0, 5.0, 0.0}, {0.0, -3.0, 200.0, 1.0, 0.0, 5.0, 0.0}};
  const Alignment alignment =
      align(scanLevel(corridor, stand(1.0, 0.2, 2.0), 1), scanLevel(corridor, stand(0.0, 0.0, 0.0), 2), {});
  EXPECT_EQ(alignment.verdict, ClosureVerdict::Degenerate) << alignment.sentence;
  ASSERT_EQ(alignment.free_directions.size(), 1U);
  EXPECT_GT(std::abs(alignment.free_directions[0][0]), 0.99);
  for (const int i : {2, 3, 4}) EXPECT_NEAR(alignment.free_directions[0][i], 0.0, 1e-6);
  EXPECT_NEAR(alignment.T_target_source.t().y(), 0.2, 0.03);
  expectFinite(alignment);
}

TEST(Align, PlanarScansOfDifferentPlacesAreRejected) {
  int rejected = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Alignment alignment =
        align(scanLevel(courtyard(seed), stand(0.0, 0.0, 0.0), 1),
              scanLevel(courtyard(seed + 100), stand(0.0, 0.0, 40.0), 2), {}, {}, SearchMode::AtOnce);
    rejected += alignment.verdict == ClosureVerdict::Rejected ? 1 : 0;
  }
  EXPECT_GE(rejected, 19) << "courtyards are rectangles, and two may have the same sides";
}

TEST(Align, AFacadeLeavesItsDirectionFree) {
  const Pair pair = makePair(urban_nav_core::testing::facade(), stand(3.0, 0.2, 2.0), stand(0.0, 0.0, 0.0), 1);
  const Alignment alignment = align(pair.source, pair.target, {});
  EXPECT_EQ(alignment.verdict, ClosureVerdict::Degenerate);
  EXPECT_EQ(alignment.reason, AlignmentReason::FreeDirections);
  ASSERT_EQ(alignment.free_directions.size(), 1U);
  EXPECT_GT(std::abs(alignment.free_directions[0][0]), 0.99);
  EXPECT_LT((alignment.information * alignment.free_directions[0]).norm(), 1e-9 * alignment.information.norm());
  EXPECT_NEAR(alignment.covariance(0, 0), 1e6, 1e5);
  EXPECT_LT(squaredDeviations(alignment, pair.truth), 22.5);
  EXPECT_GT(alignment.information(1, 1), 100.0) << "10 cm across the front";
  expectFinite(alignment);
}

TEST(Align, GroundHoldsHeightRollAndPitchAlone) {
  const Pair pair = makePair(urban_nav_core::testing::plain(), stand(1.0, 0.7, 10.0, 1.0), stand(0.0, 0.0, 0.0), 1);
  const Alignment alignment = align(pair.source, pair.target, {});
  EXPECT_EQ(alignment.verdict, ClosureVerdict::Degenerate);
  EXPECT_EQ(alignment.free_directions.size(), 3U);
  for (const int i : {0, 1, 5}) EXPECT_LT(alignment.information(i, i), 1e-6 * alignment.information(2, 2)) << i;
  EXPECT_LT(squaredDeviations(alignment, pair.truth), 22.5);
}

TEST(Align, GivesTheSameBitsWhateverTheThreads) {
  const Pair pair = makePair(courtyard(9), stand(2.0, 1.0, 170.0), stand(0.0, 0.0, 0.0), 3);
  std::vector<Alignment> alignments;
  for (const int threads : {1, 2, 5}) {
    const urban_nav_core::ThreadLimit limit(threads);
    alignments.push_back(align(pair.source, pair.target, {}));
  }
  for (const Alignment& other : alignments) {
    EXPECT_EQ(other.T_target_source.matrix(), alignments[0].T_target_source.matrix());
    EXPECT_EQ(other.information, alignments[0].information);
    EXPECT_EQ(other.covariance, alignments[0].covariance);
  }
}

TEST(Align, BadCloudsAreNamed) {
  const PointCloud good = scan(courtyard(2), stand(0.0, 0.0, 0.0), {}, 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto all = [](float x, float y, float z) {
    return PointCloud{std::vector<Eigen::Vector3f>(1000, Eigen::Vector3f(x, y, z)), {}};
  };
  const PointCloud empty, ten{{good.points.begin(), good.points.begin() + 10}, {}};
  const PointCloud nothing = all(nan, nan, nan), same = all(1.0F, 2.0F, 3.0F), absurd = all(1e30F, 1e30F, 1e30F);
  PointCloud line;
  for (int i = 0; i < 1000; ++i) line.points.emplace_back(0.1F * static_cast<float>(i), 0.0F, 0.0F);
  struct Case {
    const PointCloud* cloud;
    AlignmentReason reason;
  };
  for (const Case& each : {Case{&empty, AlignmentReason::TooFewPoints}, Case{&ten, AlignmentReason::TooFewPoints},
                           Case{&nothing, AlignmentReason::TooFewPoints}, Case{&absurd, AlignmentReason::TooFewPoints},
                           Case{&same, AlignmentReason::NoSurfaces}, Case{&line, AlignmentReason::NoSurfaces}}) {
    for (const bool swapped : {false, true}) {
      const Alignment alignment = swapped ? align(good, *each.cloud, {}) : align(*each.cloud, good, {});
      EXPECT_EQ(alignment.verdict, ClosureVerdict::Rejected);
      EXPECT_EQ(alignment.reason, each.reason) << alignment.sentence;
      EXPECT_FALSE(alignment.sentence.empty());
      EXPECT_EQ(alignment.information, Matrix6d::Zero());
      expectFinite(alignment);
    }
  }
}

TEST(Align, AnotherScaleIsRejected) {
  const PointCloud good = scan(courtyard(2), stand(0.0, 0.0, 0.0), {}, 1);
  for (const float scale : {0.001F, 0.3F, 2.0F, 1000.0F}) {
    PointCloud scaled = good;
    for (Eigen::Vector3f& point : scaled.points) point *= scale;
    const Alignment alignment = align(scaled, good, {});
    EXPECT_EQ(alignment.verdict, ClosureVerdict::Rejected) << scale;
    expectFinite(alignment);
  }
}

TEST(Align, BeamsWithoutReturnDoNotMatter) {
  const Pair pair = makePair(courtyard(3), stand(1.0, 0.5, 5.0), stand(0.0, 0.0, 0.0), 4);
  PointCloud source;
  for (const Eigen::Vector3f& point : pair.source.points) {
    source.points.push_back(point);
    source.points.push_back({point.x(), std::numeric_limits<float>::quiet_NaN(), 0.0F});
  }
  const Alignment with = align(source, pair.target, {}), without = align(pair.source, pair.target, {});
  EXPECT_EQ(with.T_target_source.matrix(), without.T_target_source.matrix());
  EXPECT_EQ(with.source_left_out, pair.source.points.size());
}

TEST(Align, AThirdOfOutliersIsBorne) {
  Dice dice(8);
  Pair pair = makePair(courtyard(4), stand(1.0, 0.5, 5.0), stand(0.0, 0.0, 0.0), 5);
  for (Eigen::Vector3f& point : pair.source.points)
    if (dice.chance(0.3))
      point += Eigen::Vector3f(static_cast<float>(dice.uniform(-5, 5)), static_cast<float>(dice.uniform(-5, 5)),
                               static_cast<float>(dice.uniform(-2, 5)));
  const Alignment alignment = align(pair.source, pair.target, {});
  EXPECT_LT(distanceBetween(alignment.T_target_source, pair.truth), 0.05);
  EXPECT_LT(angleBetween(alignment.T_target_source, pair.truth) * kDeg, 0.3);
}

}  // namespace
}  // namespace urban_nav_registration
