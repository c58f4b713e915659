// SPDX-License-Identifier: BSD-3-Clause
#include "world/world.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "materials/material.hpp"
#include "motion/simulate_drive.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

const World& testWorld(const std::string& name) {
  static std::map<std::string, World> worlds;
  const auto found = worlds.find(name);
  return found != worlds.end() ? found->second : worlds.emplace(name, buildWorld(name, 7, 1)).first->second;
}

class Worlds : public ::testing::TestWithParam<std::string> {};
class Towns : public Worlds {};

/// The legs of all routes, sampled every 0.1 m, in cells of 1 m.
std::set<std::pair<int, int>> coveredCells(const std::vector<Vector2d>& places) {
  std::set<std::pair<int, int>> cells;
  for (const Vector2d& p : places) {
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j)
        cells.emplace(static_cast<int>(std::floor(p.x())) + i, static_cast<int>(std::floor(p.y())) + j);
    }
  }
  return cells;
}

std::vector<Vector2d> samplePositions(const Route& route, double step) {
  std::vector<Vector2d> places;
  for (std::size_t i = 1; i < route.waypoints.size(); ++i) {
    const Vector2d a = route.waypoints[i - 1].position, d = route.waypoints[i].position - a;
    const int n = std::max(1, static_cast<int>(std::ceil(d.norm() / step)));
    for (int k = 0; k <= n; ++k) places.push_back(a + d * k / n);
  }
  return places;
}

TEST_P(Worlds, OneOfTheRoutesCreeps) {
  const std::vector<Route> routes = worldRoutes(GetParam(), 7);
  const auto creep =
      std::find_if(routes.begin(), routes.end(), [](const Route& route) { return route.name == "creep"; });
  ASSERT_NE(creep, routes.end());
  DriveOptions options;
  options.duration = 15.0;
  const auto motion = simulateDrive(testWorld(GetParam()), *creep, options);
  const auto way = [&](double a, double b) {
    return (motion->at(b).T_world_base.t() - motion->at(a).T_world_base.t()).head<2>().norm();
  };
  EXPECT_NEAR(way(3.0, 13.0), 0.2, 0.04);  // at 2 cm/s, and it sways
  EXPECT_LT(way(0.0, 3.0), 0.09);
}

TEST_P(Worlds, RoutesKeepClearOfObstacles) {
  const World& world = testWorld(GetParam());
  std::vector<Vector2d> places;
  for (const Route& route : worldRoutes(GetParam(), 7)) {
    ASSERT_GE(route.waypoints.size(), 2U) << route.name;
    const std::vector<Vector2d> some = samplePositions(route, 0.1);
    places.insert(places.end(), some.begin(), some.end());
  }
  const auto cells = coveredCells(places);
  double nearest = 1e9;
  for (const Part& part : world.parts) {
    for (const auto& t : part.triangles) {
      const Vector3d a = part.vertices[t[0]].cast<double>(), b = part.vertices[t[1]].cast<double>(),
                     c = part.vertices[t[2]].cast<double>();
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      const int n = std::clamp(static_cast<int>(std::ceil(longest / 0.15)), 1, 400);
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) {
          const Vector3d p = a + (b - a) * i / n + (c - a) * j / n;
          if (cells.count({static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))}) == 0) continue;
          const double above = p.z() - world.ground(p.x(), p.y());
          if (above < 0.03 || above > 2.2) continue;
          for (const Vector2d& r : places) nearest = std::min(nearest, (r - p.head<2>()).norm());
        }
      }
    }
  }
  EXPECT_GT(nearest, 0.8);
}

TEST_P(Worlds, LegsAreLongEnoughToDriveAndStartAtTheOrigin) {
  std::set<std::string> names;
  for (const Route& route : worldRoutes(GetParam(), 7)) {
    names.insert(route.name);
    double length = 0.0;
    for (std::size_t i = 1; i < route.waypoints.size(); ++i)
      length += (route.waypoints[i].position - route.waypoints[i - 1].position).norm();
    EXPECT_GT(length, 100.0) << route.name;
    EXPECT_LT(route.waypoints.front().position.norm(), 1e-9) << route.name;
  }
  EXPECT_TRUE(names.count("loops") == 1 && names.count("reversed") == 1);
}

TEST_P(Worlds, MeshFollowsTheGroundThatWheelsRollOn) {
  const World& world = testWorld(GetParam());
  const auto cells = coveredCells(samplePositions(worldRoutes(GetParam(), 7)[0], 0.5));
  std::set<std::pair<int, int>> covered;
  double worst = 0.0;
  for (const Part& part : world.parts) {
    for (const auto& t : part.triangles) {
      const Vector3d a = part.vertices[t[0]].cast<double>(), b = part.vertices[t[1]].cast<double>(),
                     c = part.vertices[t[2]].cast<double>();
      const Vector3d normal = (b - a).cross(c - a);
      if (normal.z() < 0.95 * normal.norm()) continue;  // walls reach down below the ground
      std::vector<Vector3d> samples = {(a + b + c) / 3, (a + b) / 2, (b + c) / 2, (c + a) / 2};
      const int n = static_cast<int>(std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}) / 0.5);
      for (int i = 0; i <= n && n > 0; ++i)
        for (int j = 0; i + j <= n; ++j) samples.emplace_back(a + (b - a) * i / n + (c - a) * j / n);
      for (const Vector3d& p : samples) {
        const std::pair<int, int> cell(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())));
        const double off = std::abs(p.z() - world.ground(p.x(), p.y()));
        if (cells.count(cell) == 0 || off > 0.02) continue;
        covered.insert(cell);
        worst = std::max(worst, off);
      }
    }
  }
  EXPECT_EQ(covered.size(), cells.size());
  EXPECT_LT(worst, 0.002);
}

TEST_P(Worlds, GroundIsSmooth) {
  const World& world = testWorld(GetParam());
  EXPECT_EQ(world.ground(0, 0), 0.0);
  for (int i = 0; i < 2000; ++i) {
    const double x = 0.137 * i - 100, y = 0.071 * i - 50, h = 1e-3;
    const double curvature = (world.ground(x + h, y) - 2 * world.ground(x, y) + world.ground(x - h, y)) / (h * h);
    EXPECT_LT(std::abs(curvature), 0.1);
    EXPECT_LT(std::abs(world.ground(x + h, y) - world.ground(x - h, y)) / (2 * h), 0.12);
  }
}

TEST_P(Towns, EveryClassOfSurfaceIsNearTheRoutes) {
  const World& world = testWorld(GetParam());
  std::set<SurfaceClass> classes;
  for (const Part& part : world.parts) classes.insert(world.materials.at(part.material).surface_class);
  EXPECT_EQ(classes.size(), 8U);
}

TEST_P(Worlds, IsReproducibleAndKeepsItsBuildingsOnOtherDays) {
  const World& first = testWorld(GetParam());
  if (GetParam() == "street") {  // one of them, for the time it takes
    const World again = buildWorld(GetParam(), 7, 1);
    ASSERT_EQ(first.parts.size(), again.parts.size());
    for (std::size_t i = 0; i < first.parts.size(); ++i) {
      EXPECT_EQ(first.parts[i].vertices, again.parts[i].vertices);
      EXPECT_EQ(first.parts[i].seed, again.parts[i].seed);
    }
  }
  const World later = buildWorld(GetParam(), 7, 2);
  const auto walls = [](const World& w) {
    std::vector<Vector3f> points;
    for (const Part& part : w.parts) {
      const SurfaceClass c = w.materials[part.material].surface_class;
      if (c == SurfaceClass::TexturedWall || c == SurfaceClass::SmoothWall)
        points.insert(points.end(), part.vertices.begin(), part.vertices.end());
    }
    return points;
  };
  EXPECT_EQ(walls(first), walls(later));
  EXPECT_NE(first.day.to_sun, later.day.to_sun);
}

TEST_P(Towns, HaveOtherThingsThatMoveOnOtherDays) {
  EXPECT_NE(testWorld(GetParam()).movers.size(), buildWorld(GetParam(), 7, 2).movers.size());
}

TEST_P(Worlds, HasNoCarsInEachOther) {
  const World world = buildWorld(GetParam(), 7, 2);
  std::vector<const Mover*> cars;
  for (const Mover& mover : world.movers) {
    const auto is_car = [&](const Part& part) {
      return world.materials[part.material].surface_class == SurfaceClass::Vehicle;
    };
    if (std::any_of(mover.parts.begin(), mover.parts.end(), is_car)) cars.push_back(&mover);
  }
  EXPECT_GE(cars.size(), GetParam() == "street" ? 4U : 0U);
  for (double t = 0.0; t < 300.0; t += 0.25) {
    for (std::size_t i = 0; i < cars.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Eigen::Vector3d a = cars[i]->T_world_mover(t).t(), b = cars[j]->T_world_mover(t).t();
        ASSERT_GT((a - b).norm(), 4.5) << "at " << t << " s";
      }
    }
  }
}

TEST_P(Worlds, IsMadeOfProperTriangles) {
  const World& world = testWorld(GetParam());
  std::size_t triangles = 0;
  for (const Part& part : world.parts) {
    ASSERT_LT(part.material, world.materials.size());
    ASSERT_EQ(part.vertices.size(), part.texture.size());
    triangles += part.triangles.size();
    for (const Vector3f& v : part.vertices) ASSERT_TRUE(v.allFinite());
    for (const auto& t : part.triangles) ASSERT_LT(std::max({t[0], t[1], t[2]}), part.vertices.size());
  }
  EXPECT_LT(triangles, 1500000U);
}

INSTANTIATE_TEST_SUITE_P(All, Towns, ::testing::ValuesIn(townNames()), [](const auto& of) { return of.param; });
INSTANTIATE_TEST_SUITE_P(All, Worlds, ::testing::ValuesIn(worldNames()), [](const auto& of) { return of.param; });

TEST(World, AnotherSeedIsAnotherPlace) {
  EXPECT_NE(worldRoutes("quad", 7)[0].waypoints[1].position, worldRoutes("quad", 8)[0].waypoints[1].position);
  EXPECT_NE(worldRoutes("street", 7)[0].waypoints[1].position, worldRoutes("street", 8)[0].waypoints[1].position);
}

TEST(World, TunnelIsTheSameAtEveryX) {
  const World& world = testWorld("tunnel");
  EXPECT_TRUE(world.movers.empty());
  std::set<std::pair<float, float>> section;
  std::size_t vertices = 0;
  for (const Part& part : world.parts) {
    for (const Vector3f& v : part.vertices) {
      ++vertices;
      if (v.x() > -200.0F && v.x() < 500.0F) section.emplace(v.y(), v.z());
    }
  }
  EXPECT_GT(vertices, 5000U);
  EXPECT_LT(section.size(), 20U);  // the corners of one cross-section, repeated
  std::set<std::pair<float, float>> ribbed;
  for (const Part& part : testWorld("ribbed_tunnel").parts)
    for (const Vector3f& v : part.vertices) ribbed.emplace(v.y(), v.z());
  EXPECT_GT(ribbed.size(), section.size());
}

TEST(World, FieldIsFlatAsFarAsLasersReach) {
  const World& world = testWorld("field");
  double nearest = 1e9;
  for (const Part& part : world.parts)
    for (const Vector3f& v : part.vertices)
      if (std::abs(v.z()) > 1e-6F) nearest = std::min(nearest, static_cast<double>(v.head<2>().norm()));
  for (const Route& route : worldRoutes("field", 7))
    for (const Waypoint& waypoint : route.waypoints) EXPECT_GT(nearest - waypoint.position.norm(), 120.0);
}

TEST(World, CorridorHasLiftDoorsThatMove) {
  const World& world = testWorld("corridor");
  ASSERT_GE(world.movers.size(), 4U);  // two leaves, two people
  double low = 1e9, high = -1e9;       // the lift is in a wall along x
  for (double t = 0.0; t < 14.0; t += 0.1) {
    low = std::min(low, world.movers[0].T_world_mover(t).t().x());
    high = std::max(high, world.movers[0].T_world_mover(t).t().x());
  }
  const double travel = high - low;
  EXPECT_GT(travel, 0.35);
  EXPECT_LT(travel, 0.6);
}

TEST(World, NamesWhatThereIsWhereItIsAskedForAnother) {
  EXPECT_THROW(buildWorld("atlantis", 1, 1), urban_nav_core::UserError);
  EXPECT_THROW(worldRoutes("atlantis", 1), urban_nav_core::UserError);
}

}  // namespace
}  // namespace urban_nav_sim
