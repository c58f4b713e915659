// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "support/scanned_room.hpp"
#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

std::string liveMapPath() { return ::testing::TempDir() + "live_map_test.db"; }

/// A map of the room; odometry begins at another place than the room's frame.
class LiveMapTest : public ::testing::Test {
 protected:
  LiveMapTest() : map_(Parameters(), liveMapPath()) { map_.placeLaser("laser_left", testing_room::roomLaser()); }

  void drive() {
    for (const auto& pose : trajectory_) map_.addOdometry({pose.stamp, T_odom_room_ * pose.pose});
    for (const auto& scan : testing_room::scansOfRoom(trajectory_, testing_room::roomLaser(), 0.005))
      map_.addScan("laser_left", scan);
  }
  static double median(const std::vector<MapPoint>& points, const Pose& T_room_map) {
    std::vector<double> distances;
    for (const MapPoint& point : points)
      distances.push_back(testing_room::distanceToRoom(T_room_map * point.p.cast<double>()));
    std::sort(distances.begin(), distances.end());
    return distances.empty() ? 1e9 : distances[distances.size() / 2];
  }

  const urban_nav_core::Trajectory trajectory_ = testing_room::driveThroughRoom(10.0);
  const Pose T_odom_room_ = Pose(Eigen::Matrix3d::Identity(), Vector3d(5.0, 1.0, 0.0));
  LiveMap map_;
};

TEST_F(LiveMapTest, WithoutAGraphItIsInTheFrameOfOdometry) {
  EXPECT_TRUE(map_.render().empty());
  drive();
  const auto points = map_.render();
  EXPECT_GT(points.size(), 1000U);
  EXPECT_LT(median(points, T_odom_room_.inverse()), 0.003);
}

TEST_F(LiveMapTest, FollowsThePosesOfTheGraphAndRendersOnlyWhatMoved) {
  drive();
  map_.render();
  urban_nav_core::GraphUpdate update;
  update.revision = 1;
  update.runs.emplace_back();
  for (std::size_t i = 0; i < trajectory_.size(); i += 10)
    update.runs.back().poses.push_back({trajectory_[i].stamp, trajectory_[i].pose});
  map_.addGraph(update);
  EXPECT_LT(median(map_.render(), Pose()), 0.003);
  EXPECT_EQ(map_.counts().chunks_rendered, map_.counts().chunks);
  map_.render();
  EXPECT_EQ(map_.counts().chunks_rendered, 0U);
  update.revision = 5;
  update.previous = 4;
  map_.addGraph(update);
  EXPECT_EQ(map_.counts().updates_missed, 1U);
}

TEST_F(LiveMapTest, ASessionThatBeginsAgainForgetsTheOneBefore) {
  drive();
  EXPECT_FALSE(map_.render().empty());
  map_.addOdometry({trajectory_.front().stamp - 3'000'000'000, Pose()});
  EXPECT_EQ(map_.counts().scans, 0U);
  EXPECT_TRUE(map_.render().empty());
  drive();
  EXPECT_FALSE(map_.render().empty()) << "the laser is where it was";
}

TEST_F(LiveMapTest, ScansOfALaserWithoutAPlaceAreCounted) {
  map_.addScan("laser_right", urban_nav_core::Scan());
  EXPECT_EQ(map_.counts().scans_unplaced, 1U);
}

TEST(LiveMapFile, IsRemovedWithTheMap) {
  { const LiveMap map(Parameters(), liveMapPath()); }
  EXPECT_FALSE(std::filesystem::exists(liveMapPath()));
}

std::size_t pointsIn(const std::vector<LiveMap::ChangedTile>& tiles) {
  std::size_t all = 0;
  for (const LiveMap::ChangedTile& tile : tiles) all += tile.points.size();
  return all;
}

TEST_F(LiveMapTest, TilesAreTakenOnceUntilTheyChange) {
  drive();
  const std::size_t all = map_.render().size();
  const auto first = map_.takeChanged(1);
  ASSERT_EQ(first.size(), 1U);
  const auto rest = map_.takeChanged(1'000'000);
  EXPECT_EQ(pointsIn(first) + pointsIn(rest), all);
  EXPECT_TRUE(map_.takeChanged(1'000'000).empty());
  map_.render();
  EXPECT_TRUE(map_.takeChanged(1'000'000).empty()) << "nothing has changed";
  map_.repeatAll();
  EXPECT_EQ(pointsIn(map_.takeChanged(1'000'000)), all);
  map_.clear();
  const auto emptied = map_.takeChanged(1'000'000);
  EXPECT_EQ(emptied.size(), first.size() + rest.size());
  EXPECT_EQ(pointsIn(emptied), 0U);
  EXPECT_EQ(emptied.front().revision, 2);
}

TEST_F(LiveMapTest, IsSavedAsAFile) {
  drive();
  const std::string path = ::testing::TempDir() + "live_map_test.ply";
  const std::size_t points = map_.save(path);
  EXPECT_GT(points, 1000U);
  EXPECT_EQ(urban_nav_core::readCloud(path).cloud.points.size(), points);
  std::filesystem::remove(path);
  EXPECT_THROW(map_.save("/no/such/folder/map.ply"), urban_nav_core::Error);
  EXPECT_EQ(map_.measureQuality().walls().pairs, 0U) << "one pass alone";
}

}  // namespace
}  // namespace laser_mapper
