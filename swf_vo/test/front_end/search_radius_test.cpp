// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/search_radius.hpp"

#include <gtest/gtest.h>

namespace swf_vo {
namespace {

using urban_nav_core::Pose;

constexpr double kUsual = 24.0;

/// Landmarks straight ahead at these depths, m.
std::vector<Match> landmarksAt(const std::vector<double>& depths) {
  std::vector<Match> matches;
  for (const double depth : depths) {
    Match match;
    match.p_odom = {0.0, 0.0, depth, 1.0};
    matches.push_back(match);
  }
  return matches;
}

SearchRadius makeRadius() { return {kUsual, {300.0, 300.0, 191.5, 143.5, 384, 288}, 100}; }

TEST(SearchRadius, WidensToTheUncertaintyOfThePrediction) {
  SearchRadius radius = makeRadius();
  radius.setUsual();
  radius.setLimit(0.01, Pose(), landmarksAt({2.0, 2.0, 2.0}));
  EXPECT_FALSE(radius.widen()) << "3 px are less than usual";
  radius.setLimit(0.15, Pose(), landmarksAt({2.0, 2.0, 2.0}));
  EXPECT_TRUE(radius.widen());
  EXPECT_NEAR(radius.px(), 2.0 * 300.0 * 0.15 / 2.0, 1e-9);
  EXPECT_FALSE(radius.widen());
}

TEST(SearchRadius, IsNeverWiderThanWhereNothingIsKnown) {
  SearchRadius radius = makeRadius();
  radius.setUsual();
  radius.setLimit(100.0, Pose(), landmarksAt({0.1}));
  radius.widen();
  EXPECT_LE(radius.px(), radius.anywhere());
  radius.setUnknown();
  EXPECT_LE(radius.px(), radius.anywhere());
}

TEST(SearchRadius, LandmarksWithNegativeDepthDoNotCount) {
  SearchRadius radius = makeRadius();
  radius.setUsual();
  radius.setLimit(0.15, Pose(), landmarksAt({-2.0, -0.1}));
  EXPECT_FALSE(radius.widen());
}

TEST(SearchRadius, FollowsTheErrorsOfTheLastFrame) {
  SearchRadius radius = makeRadius();
  radius.setLimit(0.0, Pose(), landmarksAt({2.0}));
  std::vector<double> errors(100, 3.0);
  radius.learn(errors);
  const double calm = radius.px();
  errors.assign(100, 6.0);
  radius.learn(errors);
  EXPECT_GT(radius.px(), calm);
  errors.assign(100, 1000.0);
  radius.learn(errors);
  EXPECT_EQ(radius.px(), kUsual) << "the limit";
}

}  // namespace
}  // namespace swf_vo
