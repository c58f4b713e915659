// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>

#include "live/live_map.hpp"
#include "urban_nav_core/testing/scanner.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Sweep;

constexpr double kWallY = 5.0;                 // m, the front of the only wall
constexpr StampNs kSweepPeriod = 100'000'000;  // ns
const char* const kSpinning = "velodyne";

Pose mountingOfLidar() { return Pose(Eigen::Quaterniond::Identity(), {0.1, 0.0, 1.5}); }
Pose poseAlongWall(int i) { return Pose(Eigen::Quaterniond::Identity(), {0.1 * i, 0.0, 0.0}); }

Sweep sweepOfWall(int i) {
  urban_nav_core::testing::World world;
  world.blocks.push_back({0.0, kWallY + 0.5, 60.0, 1.0, 0.0, 6.0, 0.0});
  urban_nav_core::testing::Scanner scanner;
  scanner.rings = 16;
  scanner.lowest = -15.0;
  scanner.highest = 15.0;
  Sweep sweep;
  sweep.reference = (i + 1) * kSweepPeriod;
  for (const Eigen::Vector3f& p : urban_nav_core::testing::scan(world, poseAlongWall(i) * mountingOfLidar(), scanner,
                                                                static_cast<std::uint64_t>(i))
                                      .points) {
    const double elevation = std::asin(static_cast<double>(p.z() / p.norm())) * 180.0 / M_PI;
    sweep.beams.push_back({sweep.reference, p.normalized(), p.norm(), 10.0F,
                           static_cast<std::uint16_t>(std::lround((elevation + 15.0) / 2.0)), 0});
  }
  return sweep;
}

class LiveLidarMap : public ::testing::Test {
 protected:
  void driveAlong(int sweeps) {
    for (int i = 0; i < sweeps; ++i) {
      map_.addOdometry({(i + 1) * kSweepPeriod, poseAlongWall(i)});
      map_.addSweep(kSpinning, sweepOfWall(i));
    }
    map_.addOdometry({(sweeps + 1) * kSweepPeriod, poseAlongWall(sweeps)});
  }
  /// Returns the points of the wall in the map, and counts those that are off it by more than 6 cm.
  std::size_t countWallPoints(std::size_t& off) {
    std::size_t count = 0;
    off = 0;
    for (const MapPoint& point : map_.render()) {
      if (point.p.z() < 0.4F || point.p.y() < 3.0F) continue;
      ++count;
      off += std::abs(static_cast<double>(point.p.y()) - kWallY) > 0.06 ? 1 : 0;
    }
    return count;
  }

  LiveMap map_{Parameters(), ::testing::TempDir() + "live_lidar_map_" + std::to_string(::getpid()) + ".db", 10.0};
};

TEST_F(LiveLidarMap, TheWallIsMappedBySweepsThatTheMotionRequires) {
  EXPECT_FALSE(map_.sensors().isPlaced(kSpinning));
  map_.sensors().placeLidar(kSpinning, mountingOfLidar());
  EXPECT_TRUE(map_.sensors().isPlaced(kSpinning));
  driveAlong(41);
  EXPECT_NEAR(static_cast<double>(map_.counts().sensors.sweeps), 14.0, 1.0) << "one in three steps of 0.1 m";
  std::size_t off = 0;
  EXPECT_GT(countWallPoints(off), 1000U);
  EXPECT_EQ(off, 0U);
}

TEST_F(LiveLidarMap, SweepsWithoutAMountingAreCounted) {
  driveAlong(5);
  EXPECT_EQ(map_.counts().sensors.unplaced, 5U);
  EXPECT_EQ(map_.counts().sensors.sweeps, 0U);
  EXPECT_TRUE(map_.render().empty());
}

TEST_F(LiveLidarMap, AClearedMapIsMadeAgain) {
  map_.sensors().placeLidar(kSpinning, mountingOfLidar());
  driveAlong(20);
  std::size_t off = 0;
  const std::size_t before = countWallPoints(off);
  map_.clear();
  EXPECT_TRUE(map_.render().empty());
  driveAlong(20);
  EXPECT_GT(before, 0U);
  EXPECT_EQ(countWallPoints(off), before);
}

}  // namespace
}  // namespace laser_mapper
