// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/revisits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "laser_mapper/chunk_renderer.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;

constexpr double kReach = 15.0;

/// Drives along x at 1 m/s from `from` to `to` (m), at `y` (m), beginning at second `begin`.
void driveAlong(Trajectory& trajectory, int begin, double from, double to, double y) {
  const int steps = static_cast<int>(10.0 * std::abs(to - from));
  for (int i = 0; i <= steps; ++i)
    trajectory.append(begin * 1'000'000'000LL + i * 100'000'000LL,
                      Pose(Eigen::Quaterniond::Identity(), Vector3d(from + (to - from) * i / steps, y, 0.0)));
}

/// Along a street of 300 m, back along another one 100 m beside it for 200 m, then along the last 100 m of the first.
Trajectory driveWithReturn() {
  Trajectory trajectory;
  driveAlong(trajectory, 0, 0.0, 300.0, 0.0);
  driveAlong(trajectory, 400, 300.0, 100.0, 100.0);
  driveAlong(trajectory, 700, 200.0, 300.0, 3.0);
  return trajectory;
}

TEST(Revisits, ChunksOfPlacesPassedTwiceAndNoOthers) {
  const Trajectory trajectory = driveWithReturn();
  const auto chunks = findRevisitedChunks({&trajectory}, kReach);
  ASSERT_EQ(chunks.size(), 1U);
  for (const urban_nav_core::StampedPose& pose : trajectory) {
    const Vector3d& p = pose.pose.t();
    const bool is_found = chunks[0].count(chunkBegin(pose.stamp)) != 0;
    const bool is_twice = p.y() < 50.0 && p.x() > 200.0, is_once = p.y() > 50.0 || p.x() < 200.0 - kReach - 4.0;
    EXPECT_TRUE(is_found || !is_twice) << p.transpose();
    EXPECT_FALSE(is_found && is_once) << p.transpose();
  }
}

TEST(Revisits, SessionsMeetEachOther) {
  Trajectory monday, tuesday;
  driveAlong(monday, 1000, 0.0, 100.0, 0.0);
  driveAlong(tuesday, 90000, 80.0, 200.0, 2.0);
  const auto chunks = findRevisitedChunks({&monday, &tuesday}, kReach);
  ASSERT_EQ(chunks.size(), 2U);
  EXPECT_EQ(chunks[0].count(chunkBegin(monday.back().stamp)), 1U);
  EXPECT_EQ(chunks[0].count(chunkBegin(monday.front().stamp)), 0U);
  EXPECT_EQ(chunks[1].count(chunkBegin(tuesday.front().stamp)), 1U);
  EXPECT_EQ(chunks[1].count(chunkBegin(tuesday.back().stamp)), 0U);
}

TEST(Revisits, AStationaryRobotRevisitsNothing) {
  Trajectory standing;
  for (int i = 0; i < 3000; ++i) standing.append(i * 100'000'000LL, Pose());
  EXPECT_TRUE(findRevisitedChunks({&standing}, kReach).at(0).empty());
  EXPECT_TRUE(findRevisitedChunks({}, kReach).empty());
  const Trajectory nothing;
  EXPECT_TRUE(findRevisitedChunks({&nothing}, kReach).at(0).empty());
}

}  // namespace
}  // namespace laser_mapper
