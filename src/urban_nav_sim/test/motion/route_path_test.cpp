// SPDX-License-Identifier: BSD-3-Clause
#include "motion/route_path.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector2d;

Route makeRoute(const std::vector<Waypoint>& waypoints) { return {"test", "", waypoints}; }

TEST(RoutePath, GoesThroughItsWaypointsAtTheirSpeeds) {
  const RoutePath way(makeRoute({{{0, 0}, 9.0, 0.0}, {{10, 0}, 1.0, 0.0}, {{10, 5}, 0.5, 0.0}}), 12.0);
  EXPECT_LT((way.at(0.0) - Vector2d(0, 0)).norm(), 1e-12);
  EXPECT_LT((way.at(4.0) - Vector2d(4, 0)).norm(), 1e-12);
  EXPECT_LT((way.at(13.0) - Vector2d(10, 3)).norm(), 1e-12);
  EXPECT_LT((way.direction(9.99) - Vector2d(1, 0)).norm(), 1e-12);
  EXPECT_LT((way.direction(10.0) - Vector2d(0, 1)).norm(), 1e-12);
  EXPECT_EQ(way.speed(9.99), 1.0);
  EXPECT_EQ(way.speed(10.0), 0.5);
  EXPECT_FALSE(way.nextStop(0.0));
}

TEST(RoutePath, OpenOnesComeBackAtTheSameSpeeds) {
  const RoutePath way(makeRoute({{{0, 0}, 9.0, 0.0}, {{10, 0}, 1.0, 0.0}, {{10, 5}, 0.5, 0.0}}), 50.0);
  EXPECT_LT((way.at(17.0) - Vector2d(10, 3)).norm(), 1e-12);
  EXPECT_EQ(way.speed(17.0), 0.5);
  EXPECT_EQ(way.speed(25.0), 1.0);
  EXPECT_LT((way.at(32.0) - Vector2d(2, 0)).norm(), 1e-12);
  ASSERT_TRUE(way.nextStop(0.0));
  EXPECT_EQ(way.nextStop(0.0)->at, 15.0);  // to turn round
  EXPECT_EQ(way.nextStop(15.0)->at, 30.0);
}

TEST(RoutePath, ClosedOnesGoOn) {
  const RoutePath way(makeRoute({{{0, 0}}, {{10, 0}}, {{10, 10}}, {{0, 10}}, {{0, 0.5}}}), 100.0);
  EXPECT_LT((way.at(39.5) - Vector2d(0, 0.5)).norm(), 1e-12);
  const double to_second = Vector2d(10, -0.5).norm();
  EXPECT_LT((way.at(39.5 + to_second + 4.0) - Vector2d(10, 4)).norm(), 1e-12);
  EXPECT_FALSE(way.nextStop(0.0));
}

TEST(RoutePath, StopsWhereThereAreSharpCornersAndPauses) {
  const RoutePath way(
      makeRoute({{{0, 0}, 1.0, 4.0}, {{10, 0}, 1.0, 2.5}, {{20, 0}, 1.0, 0.0}, {{12, 1}, 1.0, 0.0}, {{12, 9}}}), 36.0);
  const auto pause = way.nextStop(0.0);
  ASSERT_TRUE(pause);
  EXPECT_EQ(pause->at, 10.0);
  EXPECT_EQ(pause->pause, 2.5);
  const auto corner = way.nextStop(pause->at);
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->at, 20.0);
  EXPECT_EQ(corner->pause, 0.0);
}

TEST(RoutePath, WaypointsInOnePlaceAreOne) {
  const RoutePath way(makeRoute({{{0, 0}, 1.0, 0.0}, {{5, 0}, 1.0, 1.0}, {{5.01, 0}, 1.0, 2.0}, {{9, 0}, 1.0, 0.0}}),
                      8.0);
  ASSERT_TRUE(way.nextStop(0.0));
  EXPECT_EQ(way.nextStop(0.0)->pause, 3.0);
}

TEST(RoutePath, LeadsSomewhere) {
  EXPECT_THROW(RoutePath(makeRoute({}), 10.0), urban_nav_core::UserError);
  EXPECT_THROW(RoutePath(makeRoute({{{1, 1}}, {{1.3, 1}}}), 10.0), urban_nav_core::UserError);
}

}  // namespace
}  // namespace urban_nav_sim
