// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/tiles/tile_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "support/scanned_room.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/map_tile.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_store::Store;

constexpr const char* kRoom = "0123456789abcdef0123";

class TileStoreTest : public ::testing::Test {
 protected:
  TileStoreTest() {
    urban_nav_store::removeStore(path_);
    store_ = std::make_unique<Store>(path_, urban_nav_store::Access::Write);
    store_->sessions().put(urban_nav_store::Session{kRoom, "room", "", "", 1, true});
    store_->sessions().put(kRoom, urban_nav_store::Extrinsic{"laser_left", testing_room::roomLaser()});
    for (const auto& scan : testing_room::scansOfRoom(trajectory_, testing_room::roomLaser(), 0.005))
      store_->scans().put(kRoom, "laser_left", scan);
    store_->commit();
  }
  ~TileStoreTest() override {
    store_.reset();
    urban_nav_store::removeStore(path_);
  }

  static TiledSession sessionAlong(const Trajectory& trajectory) {
    TiledSession session{kRoom, 0, {}};
    for (const urban_nav_core::StampedPose& pose : trajectory) session.stamps.push_back(pose.stamp);
    return session;
  }

  /// Renders the map along a trajectory and writes its tiles; returns its points.
  std::vector<MapPoint> writeTiles(const Trajectory& trajectory) {
    LaserMap map(Parameters(), *store_, {{kRoom, &trajectory, nullptr}});
    map.render();
    TileWriter writer(*store_, {sessionAlong(trajectory)}, Parameters().voxel);
    std::vector<MapPoint> all;
    map.forEachTile([&](const Tile& tile, const std::vector<MapPoint>& points) {
      writer.add(tile, points);
      all.insert(all.end(), points.begin(), points.end());
    });
    writer.finish();
    return all;
  }

  std::vector<TilePoint> storedPoints() {
    std::vector<TilePoint> all;
    const TileList list = storedTileList(*store_, kRoom).value();
    for (const ListedTile& listed : list.tiles) {
      const std::vector<TilePoint> points = storedTilePoints(*store_, kRoom, listed.tile);
      EXPECT_EQ(points.size(), listed.points) << toString(listed.tile);
      all.insert(all.end(), points.begin(), points.end());
    }
    return all;
  }

  const std::string path_ = ::testing::TempDir() + "tile_store_test.db";
  const Trajectory trajectory_ = testing_room::driveThroughRoom(20.0);
  std::unique_ptr<Store> store_;
};

TEST_F(TileStoreTest, AllLevelsTogetherAreTheMap) {
  std::vector<TilePoint> expected;
  for (const MapPoint& point : writeTiles(trajectory_)) {
    expected.push_back(toTilePoint(point, Parameters().voxel));
    expected.back().pose = static_cast<std::uint32_t>(trajectory_.nearest(point.stamp));
  }
  std::vector<TilePoint> stored = storedPoints();
  ASSERT_GT(stored.size(), 5000U);
  std::sort(expected.begin(), expected.end());
  std::sort(stored.begin(), stored.end());
  EXPECT_TRUE(stored == expected);
  EXPECT_EQ(storedTileList(*store_, kRoom)->points(), expected.size());
}

TEST_F(TileStoreTest, TheListDescribesTheTiles) {
  writeTiles(trajectory_);
  const TileList list = *storedTileList(*store_, kRoom);
  EXPECT_EQ(list.sessions.at(0).poses, trajectory_.size());
  int level = kCoarsestLevel;
  for (const ListedTile& listed : list.tiles) {
    EXPECT_LE(listed.tile.level, level) << "coarse levels first";
    level = listed.tile.level;
    bool has_pose = false;
    for (const TilePoint& point : storedTilePoints(*store_, kRoom, listed.tile)) {
      EXPECT_TRUE(coveringTile(finestTile(point), listed.tile.level) == listed.tile);
      EXPECT_GE(point.z, listed.lowest);
      EXPECT_LE(point.z, listed.highest);
      has_pose = has_pose || (point.pose == listed.pose && point.session == listed.session);
    }
    EXPECT_TRUE(has_pose) << toString(listed.tile);
  }
  EXPECT_EQ(level, 0);
}

TEST_F(TileStoreTest, BytesDoNotDependOnTheNumberOfThreads) {
  const auto dumpWith = [&](int threads) {
    const urban_nav_core::ThreadLimit limit(threads);
    writeTiles(trajectory_);
    std::string bytes;
    urban_nav_store::TableStore<urban_nav_store::MapTile>(*store_).forEach(
        kRoom, [&](const urban_nav_store::MapTile& row) { bytes += row.tile + "\n" + row.data; });
    return bytes;
  };
  const std::string one = dumpWith(1);
  EXPECT_GT(one.size(), 1000U);
  EXPECT_TRUE(dumpWith(2) == one) << "and a map written again replaces its tiles";
}

/// Returns the distance of each point of `followed` to the nearest of `rendered` within 5 cm, sorted.
std::vector<double> distancesTo(std::vector<Vector3d> rendered, const std::vector<Vector3d>& followed) {
  constexpr double kFarthest = 0.05;
  const auto byX = [](const Vector3d& a, const Vector3d& b) { return a.x() < b.x(); };
  std::sort(rendered.begin(), rendered.end(), byX);
  std::vector<double> distances;
  for (const Vector3d& p : followed) {
    double least = kFarthest;
    auto near = std::lower_bound(rendered.begin(), rendered.end(), p - Vector3d(kFarthest, 0.0, 0.0), byX);
    for (; near != rendered.end() && near->x() <= p.x() + kFarthest; ++near)
      least = std::min(least, (*near - p).norm());
    distances.push_back(least);
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

TEST_F(TileStoreTest, PointsThatFollowTheirPosesAreThoseOfARenderingFromScratch) {
  // Both motions take the grid of the voxels to itself, so that rendering anew groups the same beams, except those on
  // the faces of voxels, where the walls of this room are: a turn takes the lower face of a voxel to the upper one of
  // another.
  const double voxel = Parameters().voxel, rounding = 0.5 * std::sqrt(3.0) * voxel / kVoxelSteps + 2e-5;
  for (const double turn : {0.0, M_PI_2}) {
    forgetChunks(*store_, kRoom);
    writeTiles(trajectory_);
    const Pose T_new_old(Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ())), Vector3d(25.6, -12.8, 0.0));
    const Trajectory moved = transformed(T_new_old, trajectory_);
    std::vector<Vector3d> followed, rendered;
    for (const TilePoint& point : storedPoints())
      followed.push_back(moved[point.pose].pose * (trajectory_[point.pose].pose.inverse() * tilePlace(point, voxel)));
    forgetChunks(*store_, kRoom);
    for (const MapPoint& point : writeTiles(moved)) rendered.push_back(point.p.cast<double>());
    const auto count = static_cast<double>(rendered.size());
    ASSERT_NEAR(static_cast<double>(followed.size()), count, 0.002 * count);
    const std::vector<double> apart = distancesTo(rendered, followed);
    EXPECT_LT(apart[apart.size() * (turn == 0.0 ? 99 : 90) / 100], rounding) << turn;
  }
}

TEST_F(TileStoreTest, TheSessionOfAPointIsThatOfItsPass) {
  TileWriter writer(*store_, {{kRoom, 0, {10, 20}}, {"empty", std::nullopt, {}}, {"later", 3, {100, 200}}}, 0.05);
  std::vector<MapPoint> points(4);
  const std::uint16_t passes[] = {0, 2, 3, 9};
  const urban_nav_core::StampNs stamps[] = {14, 999, 150, 151};
  for (std::size_t i = 0; i < 4; ++i) {
    points[i].p.x() = 1.0F + static_cast<float>(i);
    points[i].pass = passes[i];
    points[i].stamp = stamps[i];
  }
  writer.add({0, 0}, points);
  writer.finish();
  std::vector<TilePoint> stored = storedPoints();
  ASSERT_EQ(stored.size(), 4U);
  std::sort(stored.begin(), stored.end(), [](const TilePoint& a, const TilePoint& b) { return a.x < b.x; });
  const std::uint16_t sessions[] = {0, 0, 2, 2};
  const std::uint32_t poses[] = {0, 1, 0, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(stored[i].session, sessions[i]) << i;
    EXPECT_EQ(stored[i].pose, poses[i]) << i;
  }
}

TEST_F(TileStoreTest, AStoreWithoutTilesHasNoList) {
  EXPECT_FALSE(storedTileList(*store_, kRoom));
  EXPECT_FALSE(storedTile(*store_, kRoom, {0, {0, 0}}));
  EXPECT_TRUE(storedTilePoints(*store_, kRoom, {0, {0, 0}}).empty());
}

TEST_F(TileStoreTest, ForgottenTilesAreGone) {
  writeTiles(trajectory_);
  forgetTiles(*store_, kRoom);
  std::size_t rows = 0;
  urban_nav_store::TableStore<urban_nav_store::MapTile>(*store_).forEach(
      kRoom, [&](const urban_nav_store::MapTile&) { ++rows; });
  EXPECT_EQ(rows, 0U);
}

TEST_F(TileStoreTest, TilesOfAnUnfinishedWriterAreNotShown) {
  writeTiles(trajectory_);
  {
    TileWriter writer(*store_, {{kRoom, 0, {1}}}, Parameters().voxel);
    MapPoint point;
    writer.add({0, 0}, {point});
  }
  EXPECT_FALSE(storedTileList(*store_, kRoom));
}

TEST_F(TileStoreTest, DamagedTilesAreReported) {
  writeTiles(trajectory_);
  urban_nav_store::TableStore<urban_nav_store::MapTile> rows(*store_);
  const LevelTile tile = storedTileList(*store_, kRoom)->tiles.back().tile;
  rows.put({kRoom, toString(tile), 1, "damaged"});
  EXPECT_THROW(storedTilePoints(*store_, kRoom, tile), urban_nav_core::DataError);
  rows.put({kRoom, "", 1, "damaged"});
  EXPECT_THROW(storedTileList(*store_, kRoom), urban_nav_core::DataError);
}

}  // namespace
}  // namespace laser_mapper
