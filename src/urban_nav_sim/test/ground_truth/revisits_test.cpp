// SPDX-License-Identifier: BSD-3-Clause
#include "ground_truth/revisits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace urban_nav_sim {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Trajectory;

constexpr double kHalfSecond = 0.5;

// 2 Hz on a circle of 20 m, on which every other round goes backwards.
Trajectory rounds(double duration) {
  Trajectory trajectory;
  for (int i = 0; i * kHalfSecond < duration; ++i) {
    const double t = i * kHalfSecond, turns = t / 100.0;
    const bool back = static_cast<int>(turns) % 2 == 1;
    const double angle = 2.0 * M_PI * (back ? -turns : turns), yaw = angle + (back ? -M_PI / 2 : M_PI / 2);
    trajectory.append(
        1'000'000'000LL * 1'225'719'873 + i * 500'000'000LL,
        Pose(urban_nav_core::expSo3({0, 0, yaw}), {20 * std::cos(angle), 20 * std::sin(angle), 0.1 * turns}));
  }
  return trajectory;
}

double gap(const Trajectory& panoramas, std::size_t a, std::size_t b) {
  return urban_nav_core::secondsBetween(panoramas[a].stamp, panoramas[b].stamp);
}

TEST(Revisits, AreAllPairsNearInSpaceAndFarInTime) {
  const Trajectory panoramas = rounds(420.0);
  std::set<std::pair<std::size_t, std::size_t>> wanted, found;
  for (std::size_t b = 0; b < panoramas.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const bool near = (panoramas[a].pose.t() - panoramas[b].pose.t()).norm() <= 7.5;
      if (near && gap(panoramas, a, b) > 30.0) wanted.insert({a, b});
    }
  }
  for (const Revisit& each : findRevisits(panoramas)) found.insert({each.a, each.b});
  EXPECT_GT(wanted.size(), 1000U);
  EXPECT_EQ(found, wanted);
}

TEST(Revisits, HaveDistanceAndHeading) {
  const Trajectory panoramas = rounds(300.0);
  int same = 0, opposite = 0;
  for (const Revisit& each : findRevisits(panoramas)) {
    EXPECT_NEAR(each.distance, (panoramas[each.a].pose.t() - panoramas[each.b].pose.t()).norm(), 1e-12);
    EXPECT_LE(std::abs(each.heading_deg), 180.0);
    const Pose turned = panoramas[each.a].pose.inverse() * panoramas[each.b].pose;
    EXPECT_NEAR(std::remainder(urban_nav_core::logSo3(turned.q()).z() * 180.0 / M_PI - each.heading_deg, 360.0), 0.0,
                1e-9);
    same += std::abs(each.heading_deg) < 45.0 ? 1 : 0;
    opposite += std::abs(each.heading_deg) > 135.0 ? 1 : 0;
  }
  EXPECT_GT(same, 100);
  EXPECT_GT(opposite, 100);
}

TEST(Revisits, ThereAreNoneWithoutRevisits) {
  EXPECT_TRUE(findRevisits(Trajectory()).empty());
  EXPECT_TRUE(findRevisits(rounds(29.0)).empty());
}

TEST(Closures, TrueOnesAreTheNearestRevisits) {
  const Trajectory panoramas = rounds(300.0);
  const auto revisits = findRevisits(panoramas);
  const auto closures = trueClosures(revisits, Noise(7, "closures"));
  std::set<std::size_t> revisited;
  for (const Revisit& each : revisits) revisited.insert(each.b);
  ASSERT_EQ(closures.size(), revisited.size());
  for (const Closure& each : closures) {
    const double distance = urban_nav_core::distanceBetween(panoramas[each.a].pose, panoramas[each.b].pose);
    EXPECT_LE(distance, 7.5);
    EXPECT_GT(gap(panoramas, each.a, each.b), 30.0);
    EXPECT_TRUE(each.probability >= 0.99 && each.probability <= 1.0);
    for (const Revisit& other : revisits) {
      EXPECT_TRUE(other.b != each.b || distance <= other.distance + 1e-12);
    }
  }
}

TEST(Closures, FalseOnesAreFarApart) {
  const Trajectory panoramas = rounds(300.0);
  const auto closures = falseClosures(panoramas, 90, Noise(7, "closures"));
  ASSERT_EQ(closures.size(), 90U);
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (const Closure& each : closures) {
    EXPECT_GT(urban_nav_core::distanceBetween(panoramas[each.a].pose, panoramas[each.b].pose), 7.5);
    EXPECT_GT(gap(panoramas, each.a, each.b), 30.0);
    pairs.insert({each.a, each.b});
  }
  EXPECT_EQ(pairs.size(), 90U);
  EXPECT_NE(falseClosures(panoramas, 90, Noise(8, "closures"))[0].a, closures[0].a);
}

TEST(Closures, ThereAreNoFalseOnesWhereAllIsOnePlace) {
  Trajectory standing;
  for (int i = 0; i < 200; ++i) standing.append(i * 500'000'000LL, Pose());
  EXPECT_TRUE(falseClosures(standing, 5, Noise(7, "closures")).empty());
  EXPECT_TRUE(falseClosures(Trajectory(), 5, Noise(7, "closures")).empty());
  EXPECT_GT(trueClosures(findRevisits(standing), Noise(7, "closures")).size(), 100U);
}

}  // namespace
}  // namespace urban_nav_sim
