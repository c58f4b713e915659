// SPDX-License-Identifier: BSD-3-Clause
#include "motion/simulate_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "motion/ground_contact.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

World levelWorld() {
  World world;
  world.ground = [](double, double) { return 0.0; };
  return world;
}

// Slopes of up to 12 % in all directions.
World hillyWorld() {
  World world;
  world.ground = [](double x, double y) { return 0.8 * std::sin(0.15 * x) * std::cos(0.11 * y) + 0.02 * x; };
  return world;
}

Route routeThrough(const std::vector<Vector2d>& places, double speed = 1.3) {
  Route route;
  route.name = "test";
  for (const Vector2d& place : places) {
    Waypoint waypoint;
    waypoint.position = place;
    waypoint.speed = speed;
    route.waypoints.push_back(waypoint);
  }
  return route;
}

Route loop() { return routeThrough({{0, 0}, {20, 0}, {20, 12}, {8, 12}, {0, 6}, {0, 0}}); }
Route thereAndBack() { return routeThrough({{0, 0}, {15, 2}, {25, 0}}); }
Route circle() {
  std::vector<Vector2d> places;
  for (int i = 0; i <= 60; ++i) places.push_back({8 * std::sin(i * M_PI / 30), 8 - 8 * std::cos(i * M_PI / 30)});
  return routeThrough(places, 1.6);
}
// Corners of 60 to 150 deg, two metres apart: the sharpest route of the test.
Route zigzag() {
  return routeThrough({{0, 0}, {2, 0}, {2, 2}, {3, 0.5}, {5, 0.5}, {3.2, 1.0}, {3, 4}, {0, 4}, {0, 0}});
}

DriveOptions optionsFor(double duration, std::uint64_t seed = 1) {
  DriveOptions options;
  options.duration = duration;
  options.seed = seed;
  return options;
}

Vector2d positionAt(const Motion& motion, double t) { return motion.at(t).T_world_base.t().head<2>(); }
Vector3d axisDirection(const MotionState& motion_state, int axis) { return motion_state.T_world_base.R().col(axis); }

double distanceToLine(const Vector2d& p, const Route& route) {
  double least = 1e9;
  for (std::size_t i = 1; i < route.waypoints.size(); ++i) {
    const Vector2d a = route.waypoints[i - 1].position, d = route.waypoints[i].position - a;
    const double along = std::min(std::max(d.dot(p - a) / d.squaredNorm(), 0.0), 1.0);
    least = std::min(least, (p - a - along * d).norm());
  }
  return least;
}

TEST(MakeRide, VelocitiesAndAccelerationsAreThoseOfThePose) {
  const auto motion = simulateDrive(hillyWorld(), loop(), optionsFor(40.0));
  constexpr double kH = 1e-4;
  for (double t = -0.05; t < 40.05; t += 0.0917) {
    const MotionState before = motion->at(t - kH), now = motion->at(t), after = motion->at(t + kH);
    const Vector3d velocity = (after.T_world_base.t() - before.T_world_base.t()) / (2 * kH);
    EXPECT_LT((velocity - now.velocity_world).norm(), 1e-5) << t;
    const Vector3d acceleration = (after.velocity_world - before.velocity_world) / (2 * kH);
    EXPECT_LT((acceleration - now.acceleration_world).norm(), 1e-3) << t;
    const auto turned = before.T_world_base.q().conjugate() * after.T_world_base.q();
    EXPECT_LT((urban_nav_core::logSo3(turned) / (2 * kH) - now.rate_base).norm(), 1e-5) << t;
    const Vector3d change = (after.rate_base - before.rate_base) / (2 * kH);
    EXPECT_LT((change - now.rate_change_base).norm(), 1e-3) << t;
  }
}

// A wheel touches the ground where the ground is nearest to its centre; it must be a radius away from there.
double measureGap(const World& world, const Vector3d& centre) {
  double nearest = 1e9;
  for (double x = -0.12; x <= 0.12; x += 0.004) {
    for (double y = -0.12; y <= 0.12; y += 0.004) {
      const Vector3d p(centre.x() + x, centre.y() + y, world.ground(centre.x() + x, centre.y() + y));
      nearest = std::min(nearest, (p - centre).norm());
    }
  }
  return nearest - kWheelRadius;
}

TEST(MakeRide, WheelsStayOnSlopedGround) {
  const World world = hillyWorld();
  for (const double roughness : {0.0, 1.0}) {
    DriveOptions options = optionsFor(60.0);
    options.roughness = roughness;
    const auto motion = simulateDrive(world, loop(), options);
    double most = 0.0;
    for (double t = 0.0; t < 60.0; t += 0.5) {
      const MotionState motion_state = motion->at(t);
      for (const double side : {-0.5, 0.5}) {
        const Vector3d on_body(0.0, side * kTrack, kWheelRadius);
        most = std::max(most, std::abs(measureGap(world, motion_state.T_world_base * on_body)));
      }
    }
    EXPECT_LT(most, roughness == 0.0 ? 5e-4 : 0.025);
  }
}

TEST(MakeRide, BaseLinkStaysOnTheGroundBetweenTheWheels) {
  const World world = hillyWorld();
  const auto motion = simulateDrive(world, loop(), optionsFor(60.0));
  for (double t = 0.0; t < 60.0; t += 0.1) {
    const Vector3d p = motion->at(t).T_world_base.t();
    EXPECT_NEAR(p.z(), world.ground(p.x(), p.y()), 0.03) << t;
  }
}

TEST(MakeRide, RollFollowsTheSlopeAcross) {
  World world;
  world.ground = [](double, double y) { return 0.1 * y; };  // up to the left of a robot that drives along x
  DriveOptions options = optionsFor(20.0);
  options.roughness = 0.0;
  const auto motion = simulateDrive(world, routeThrough({{0, 0}, {40, 0}}), options);
  for (double t = 5.0; t < 15.0; t += 0.5) {
    EXPECT_NEAR(std::asin(axisDirection(motion->at(t), 1).z()), std::atan(0.1), 0.01);
    EXPECT_GT(axisDirection(motion->at(t), 1).z(), 0.0);
  }
}

TEST(MakeRide, TiltsIntoItsAcceleration) {
  DriveOptions options = optionsFor(60.0);
  options.oscillation = 0.0;
  const auto motion = simulateDrive(levelWorld(), loop(), options);
  double both = 0.0, leans = 0.0, pushes = 0.0;
  for (double t = 0.0; t < 60.0; t += 0.05) {
    const MotionState motion_state = motion->at(t);
    const double pitch = std::asin(-axisDirection(motion_state, 0).z());
    const double push = motion_state.acceleration_world.dot(axisDirection(motion_state, 0)) / 9.81;
    both += pitch * push;
    leans += pitch * pitch;
    pushes += push * push;
  }
  EXPECT_GT(both / std::sqrt(leans * pushes), 0.7);
}

TEST(MakeRide, TiltsUphillSoThatTheMassStaysAboveTheWheels) {
  World world;
  world.ground = [](double x, double) { return 0.1 * x; };
  DriveOptions options = optionsFor(30.0);
  options.oscillation = options.roughness = 0.0;
  const auto motion = simulateDrive(world, routeThrough({{0, 0}, {60, 0}}, 1.0), options);
  for (double t = 10.0; t < 25.0; t += 1.0) {
    EXPECT_NEAR(std::asin(-axisDirection(motion->at(t), 0).z()), 0.4 * std::sin(std::atan(0.1)), 0.01);
  }
}

TEST(MakeRide, MovesAsTheRobotCan) {
  const Route routes[] = {loop(), thereAndBack(), circle(), zigzag()};
  for (const Route& route : routes) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const double duration = seed == 4 ? 24.0 : 180.0;
      const auto motion = simulateDrive(hillyWorld(), route, optionsFor(duration, seed));
      double fastest = 0.0, turns = 0.0, stands = 0.0, mean = 0.0, square = 0.0, count = 0.0, slips = 0.0;
      for (double t = 0.0; t < duration - 0.1; t += 0.1, ++count) {
        const MotionState from = motion->at(t), to = motion->at(t + 0.1);
        const double speed = (to.T_world_base.t() - from.T_world_base.t()).norm() / 0.1;
        fastest = std::max(fastest, speed);
        stands += speed < 0.1 ? 1.0 : 0.0;
        turns = std::max(turns, urban_nav_core::angleBetween(from.T_world_base, to.T_world_base) / 0.1 * 180.0 / M_PI);
        const double pitch = std::asin(-axisDirection(from, 0).z()) * 180.0 / M_PI;
        mean += pitch;
        square += pitch * pitch;
        const double lean_rate = from.rate_base.norm() * kWheelRadius;
        slips = std::max(slips, std::abs(from.velocity_world.dot(axisDirection(from, 1))) - lean_rate);
      }
      const std::string where = std::to_string(&route - routes) + " seed " + std::to_string(seed);
      EXPECT_LT(fastest, 1.6) << where;
      EXPECT_LT(turns, 80.0) << where;
      EXPECT_LT(stands / count, 0.2) << where;
      EXPECT_GT(std::sqrt(square / count - mean * mean / count / count), 0.1) << where;
      EXPECT_LT(slips, 0.02) << where;  // wheels hardly go sideways, across a slope either
    }
  }
}

TEST(MakeRide, FollowsItsWaypointsInTheirOrder) {
  for (const Route& route : {loop(), thereAndBack(), circle()}) {
    const auto motion = simulateDrive(levelWorld(), route, optionsFor(120.0));
    std::size_t next = 0;
    double off = 0.0;
    for (double t = 0.0; t < 120.0; t += 0.05) {
      const Vector2d p = positionAt(*motion, t);
      off = std::max(off, distanceToLine(p, route));
      if (next < route.waypoints.size() && (p - route.waypoints[next].position).norm() < 0.5) ++next;
    }
    EXPECT_EQ(next, route.waypoints.size());
    EXPECT_LT(off, 0.65);
  }
}

TEST(MakeRide, GoesOnInTheSameDirectionWhereTheRouteIsClosed) {
  const auto motion = simulateDrive(levelWorld(), circle(), optionsFor(150.0));
  double turned = 0.0;
  for (double t = 0.0; t < 150.0; t += 0.01) turned += 0.01 * motion->at(t).rate_base.z();
  EXPECT_GT(turned, 3.5 * 2.0 * M_PI);
}

TEST(MakeRide, ReturnsAlongAnOpenRoute) {
  const auto motion = simulateDrive(levelWorld(), thereAndBack(), optionsFor(120.0));
  int arrivals = 0;
  bool at_start = true;
  for (double t = 0.0; t < 120.0; t += 0.1) {
    const double away = positionAt(*motion, t).norm();
    if (at_start && away > 20.0) at_start = false;
    if (!at_start && away < 0.6) {
      at_start = true;
      ++arrivals;
    }
  }
  EXPECT_GE(arrivals, 2);
}

TEST(MakeRide, StopsAtItsPauses) {
  Route route = thereAndBack();
  route.waypoints[1].pause = 5.0;
  const auto motion = simulateDrive(levelWorld(), route, optionsFor(24.0));
  double stands = 0.0, away = 0.0;
  for (double t = 4.0; t < 24.0; t += 0.05) {
    const MotionState motion_state = motion->at(t);
    if (motion_state.velocity_world.norm() < 0.1) {
      stands += 0.05;
      away = std::max(away, (motion_state.T_world_base.t().head<2>() - route.waypoints[1].position).norm());
    }
  }
  EXPECT_LT(away, 0.4);
  EXPECT_GT(stands, 3.5);
  EXPECT_LT(stands, 7.0);
}

TEST(MakeRide, StartsInTheDirectionOfTheRoute) {
  const auto motion = simulateDrive(levelWorld(), routeThrough({{3, 4}, {3, 30}}), optionsFor(10.0));
  const MotionState start = motion->at(0.0);
  EXPECT_LT((start.T_world_base.t().head<2>() - Vector2d(3, 4)).norm(), 0.02);
  EXPECT_LT((axisDirection(start, 0) - Vector3d::UnitY()).norm(), 0.03);
  EXPECT_LT(start.velocity_world.norm(), 0.05);
}

TEST(MakeRide, BeginsFurtherAlongIfAsked) {
  DriveOptions options = optionsFor(10.0);
  options.start = 30.0;
  const auto motion = simulateDrive(levelWorld(), loop(), options);
  EXPECT_LT((positionAt(*motion, 0.0) - Vector2d(20, 10)).norm(), 0.1);
}

TEST(MakeRide, DependsOnTheSeedAndOnNothingElse) {
  const auto a = simulateDrive(hillyWorld(), loop(), optionsFor(30.0, 5)),
             b = simulateDrive(hillyWorld(), loop(), optionsFor(30.0, 5));
  const auto other = simulateDrive(hillyWorld(), loop(), optionsFor(30.0, 6));
  EXPECT_EQ(a->at(17.3).T_world_base.t(), b->at(17.3).T_world_base.t());
  EXPECT_GT((a->at(17.3).T_world_base.t() - other->at(17.3).T_world_base.t()).norm(), 0.01);
  // Later parts of a route do not change earlier ones.
  const auto longer = simulateDrive(hillyWorld(), loop(), optionsFor(60.0, 5));
  EXPECT_EQ(a->at(17.3).T_world_base.t(), longer->at(17.3).T_world_base.t());
}

TEST(MakeRide, RefusesRoutesThatLeadNowhere) {
  EXPECT_THROW(simulateDrive(levelWorld(), Route{}, optionsFor(10.0)), urban_nav_core::UserError);
  EXPECT_THROW(simulateDrive(levelWorld(), routeThrough({{1, 1}}), optionsFor(10.0)), urban_nav_core::UserError);
  EXPECT_THROW(simulateDrive(levelWorld(), routeThrough({{1, 1}, {1.2, 1}}), optionsFor(10.0)),
               urban_nav_core::UserError);
}

}  // namespace
}  // namespace urban_nav_sim
