// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/associate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "support/time.hpp"

namespace urban_nav_core {
namespace {

constexpr StampNs kMs = 1000000;

// Path with bends and changes of speed, sampled every `step`.
Pose wayAt(double s) {
  return Pose(expSo3({0, 0, std::sin(0.3 * s) + 0.4 * std::sin(1.1 * s)}),
              {2 * s + std::sin(0.9 * s), std::cos(0.5 * s), 0});
}
Trajectory way(double begin, double seconds, StampNs step, StampNs origin) {
  Trajectory t;
  for (StampNs at = 0; at < static_cast<StampNs>(seconds * 1e9); at += step) {
    t.append(origin + at, wayAt(begin + static_cast<double>(at) * 1e-9));
  }
  return t;
}

TEST(Associate, EqualStampsGiveThePosesThemselves) {
  const Trajectory truth = way(0, 10, 100 * kMs, 5 * kSecond);
  const Matched matched = associate(truth, truth);
  ASSERT_EQ(matched.stamps.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_TRUE(isApprox(matched.truth[i], truth[i].pose, 0.0));
}

TEST(Associate, InterpolatesADenseTruth) {
  const Trajectory truth = way(0, 10, 20 * kMs, 0);
  const Trajectory estimate = way(0.007, 9, 50 * kMs, 7 * kMs);
  const Matched matched = associate(truth, estimate);
  ASSERT_EQ(matched.stamps.size(), estimate.size());
  for (std::size_t i = 0; i < matched.stamps.size(); ++i)
    EXPECT_LT(distanceBetween(matched.truth[i], matched.estimate[i]), 2e-4);
}

TEST(Associate, StaysWithinItsTolerance) {
  const Trajectory truth = way(0, 10, kSecond, 0);
  const auto count = [&](StampNs shift) { return associate(truth, way(0, 10, kSecond, shift)).stamps.size(); };
  EXPECT_EQ(count(20 * kMs), 10U);
  EXPECT_EQ(count(20 * kMs + 1), 0U);
  EXPECT_EQ(count(-20 * kMs), 10U);
  EXPECT_TRUE(associate(Trajectory(), truth).stamps.empty());
}

TEST(Associate, APoseOfASparseTruthServesOnce) {
  const Trajectory truth = way(0, 10, kSecond, 0);
  const Matched matched = associate(truth, way(0, 10, 5 * kMs, 3 * kMs));
  EXPECT_EQ(matched.stamps.size(), 10U);
  for (const StampNs stamp : matched.stamps)
    EXPECT_LE(std::abs(stamp - (stamp + kSecond / 2) / kSecond * kSecond), 3 * kMs);
}

TEST(Associate, AppliesAnOffsetAndSurvivesOverflow) {
  const Trajectory truth = way(0, 10, 100 * kMs, 1000 * kSecond);
  const Trajectory estimate = way(0, 10, 100 * kMs, 0);
  EXPECT_EQ(associate(truth, estimate).stamps.size(), 0U);
  EXPECT_EQ(associate(truth, estimate, 1000 * kSecond).stamps.size(), 100U);
  EXPECT_TRUE(associate(truth, estimate, std::numeric_limits<StampNs>::max()).stamps.size() <= 1U);
}

TEST(Associate, ByIndexWantsEqualLengths) {
  EXPECT_FALSE(associateByIndex({Pose()}, {Pose(), Pose()}));
  EXPECT_EQ(associateByIndex({Pose(), Pose()}, {Pose(), Pose()})->truth.size(), 2U);
}

TEST(FindOffset, FindsTheShiftWhateverTheFrame) {
  const Trajectory truth = way(0, 60, 50 * kMs, 1225719873 * kSecond);
  const Pose other(expSo3({0.3, 0.4, 0.5}), {100, 200, 300});
  const Trajectory estimate = transformed(other, way(12.34, 30, 50 * kMs, 0));
  const auto found = findOffset(truth, estimate);
  ASSERT_TRUE(found);
  EXPECT_NEAR(secondsBetween(1225719873 * kSecond, found->offset), 12.34, 0.003);
  EXPECT_GT(found->correlation, 0.95);
  EXPECT_GT(found->matched, 590U);
  std::ostringstream out;
  out << *found;
  EXPECT_NE(out.str().find("1225719885.3"), std::string::npos);
}

TEST(FindOffset, SmallShiftsToo) {
  const auto found = findOffset(way(0, 30, 50 * kMs, 0), way(0, 30, 50 * kMs, -35 * kMs));
  ASSERT_TRUE(found);
  EXPECT_NEAR(static_cast<double>(found->offset) * 1e-9, 0.035, 0.003);
}

TEST(FindOffset, LinesUpTheStartsWhereNothingMoves) {
  Trajectory still_a, still_b;
  for (int i = 0; i < 100; ++i) {
    still_a.append(7 * kSecond + i * 50 * kMs, Pose());
    still_b.append(i * 50 * kMs, Pose());
  }
  const auto found = findOffset(still_a, still_b);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->offset, 7 * kSecond);
  EXPECT_EQ(found->correlation, 0.0);
  EXPECT_EQ(found->matched, 100U);
  EXPECT_FALSE(findOffset(still_a, Trajectory()));
}

}  // namespace
}  // namespace urban_nav_core
