// SPDX-License-Identifier: BSD-3-Clause
#include "motion/steering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace urban_nav_sim {
namespace {

using Eigen::Vector2d;

constexpr double kStep = 0.02;

struct Drive {
  double furthest_off = 0.0;  // the straight way, m
  double along = 0.0;         // m, at the end
  double stands = 0.0;        // s
  Vector2d stood = Vector2d::Zero();
};

double distanceToRoute(const Vector2d& p, const Route& route) {
  double least = 1e9;
  for (std::size_t i = 1; i < route.waypoints.size(); ++i) {
    const Vector2d a = route.waypoints[i - 1].position, d = route.waypoints[i].position - a;
    const double part = std::clamp(d.dot(p - a) / d.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - a - part * d).norm());
  }
  return least;
}

Drive drive(const Route& route, double duration, double start = 0.0) {
  const RoutePath way(route, 1.5 * duration + 10.0);
  SteeringModel driver(way, start, 0.08, Noise(3, "hand"));
  SegwayState state;
  state.position = way.at(start);
  state.yaw = std::atan2(way.direction(start).y(), way.direction(start).x());
  Drive result;
  for (double t = 0.0; t < duration; t += kStep) {
    const SegwayCommand command = driver.steer(state, kStep);
    for (int j = 0; j < 4; ++j) state = stepSegway(state, command, {}, kStep / 4);
    result.furthest_off = std::max(result.furthest_off, distanceToRoute(state.position, route));
    if (t > 3.0 && command.speed == 0.0) {
      result.stands += kStep;
      result.stood = state.position;
    }
  }
  result.along = driver.along();
  return result;
}

TEST(SteeringModel, FollowsAnyPathToItsEnd) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Noise noise(seed, "route");
    const double longest = seed % 3 == 0 ? 2.5 : seed % 3 == 1 ? 8.0 : 30.0;
    const double sharpest = seed % 3 == 0 ? 1.2 : 3.1;
    Route route;
    Vector2d place(0, 0);
    double direction = 0.0;
    for (std::uint64_t i = 0; i < 30; ++i) {
      route.waypoints.push_back({place, noise.uniform(3 * i, 0.8, 1.6), 0.0});
      direction += noise.uniform(3 * i + 1, -sharpest, sharpest);
      place += noise.uniform(3 * i + 2, 0.25 * longest, longest) * Vector2d(std::cos(direction), std::sin(direction));
    }
    const Drive driven = drive(route, 200.0);
    EXPECT_LT(driven.furthest_off, 0.7) << seed;
    EXPECT_GT(driven.along, 200.0 * 0.4) << seed;
  }
}

TEST(SteeringModel, PausesOnlyWhenItIsTheTurnOfThePlace) {
  // The way comes by (5, 0), where it is to pause in the end, after 5 m already.
  const Route route{"test",
                    "",
                    {{{0, 0}, 1.2, 0.0},
                     {{10, 0}, 1.2, 0.0},
                     {{10, 6}, 1.2, 0.0},
                     {{5, 6}, 1.2, 0.0},
                     {{5, 0}, 1.2, 3.0},
                     {{5, -9}, 1.2, 0.0}}};
  EXPECT_EQ(drive(route, 14.0).stands, 0.0);
  const Drive whole = drive(route, 40.0);
  EXPECT_NEAR(whole.stands, 3.0, 0.4);
  EXPECT_LT((whole.stood - Vector2d(5, 0)).norm(), 0.3);
}

TEST(SteeringModel, ComesInBothDirectionsThroughAHairpin) {
  const Route route{"test", "", {{{0, 0}, 1.2, 0.0}, {{15, 0}, 1.2, 0.0}, {{0, 0.4}, 1.2, 0.0}, {{15, 0.8}, 1.2, 0.0}}};
  const Drive driven = drive(route, 60.0);
  EXPECT_LT(driven.furthest_off, 0.7);
  EXPECT_GT(driven.along, 40.0);
}

}  // namespace
}  // namespace urban_nav_sim
