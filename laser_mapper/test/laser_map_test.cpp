// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/laser_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>

#include "laser_mapper/map_files.hpp"
#include "support/scanned_room.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_store::Store;

constexpr const char* kRoomSession = "0123456789abcdef0123";

class LaserMapTest : public ::testing::Test {
 protected:
  LaserMapTest() {
    path_ = ::testing::TempDir() + "laser_map_test.db";
    urban_nav_store::removeStore(path_);
    store_ = std::make_unique<Store>(path_, urban_nav_store::Access::Write);
    store_->sessions().put(urban_nav_store::Session{kRoomSession, "room", "", "", 1, true});
    store_->sessions().put(kRoomSession, urban_nav_store::Extrinsic{"laser_left", testing_room::roomLaser()});
    for (const auto& scan : testing_room::scansOfRoom(trajectory_, testing_room::roomLaser(), 0.005))
      store_->scans().put(kRoomSession, "laser_left", scan);
    store_->commit();
  }
  ~LaserMapTest() override {
    store_.reset();
    urban_nav_store::removeStore(path_);
  }

  /// Removes everything but the scans from the store.
  void forgetMap() {
    store_->sessions().clear(kRoomSession);
    store_->sessions().put(kRoomSession, urban_nav_store::Extrinsic{"laser_left", testing_room::roomLaser()});
  }

  /// The points, with the statistics of rendering.
  std::vector<MapPoint> mapPoints(const Trajectory& trajectory, RenderStatistics* statistics = nullptr,
                                  const std::vector<Matrix6d>* covariances = nullptr) {
    LaserMap map(Parameters(), *store_, {{kRoomSession, &trajectory, covariances}});
    const RenderStatistics rendered = map.render();
    if (statistics != nullptr) *statistics = rendered;
    std::vector<MapPoint> all;
    map.forEachTile(
        [&](const Tile&, const std::vector<MapPoint>& points) { all.insert(all.end(), points.begin(), points.end()); });
    return all;
  }

  static std::string bytes(const std::vector<MapPoint>& points) {
    std::string all;
    for (const MapPoint& point : points) appendVertex(all, point);
    return all;
  }

  const Trajectory trajectory_ = testing_room::driveThroughRoom(20.0);
  std::string path_;
  std::unique_ptr<Store> store_;
};

TEST_F(LaserMapTest, PointsAreOnTheWallsAndNormalsPointIntoTheRoom) {
  const std::vector<MapPoint> points = mapPoints(trajectory_);
  ASSERT_GT(points.size(), 5000U);
  std::vector<double> distances;
  for (const MapPoint& point : points) {
    distances.push_back(testing_room::distanceToRoom(point.p.cast<double>()));
    ASSERT_TRUE(point.p.allFinite() && point.normal.allFinite());
    EXPECT_GT(point.sigma, 0.0F);
    EXPECT_EQ(point.laser, 0);
    if (std::abs(point.p.y() - 6.0F) < 0.02F && point.p.z() > 0.3F && point.p.z() < 3.7F) {
      EXPECT_GT(point.normal.dot(-Eigen::Vector3f::UnitY()), 0.97F);
    }
  }
  std::sort(distances.begin(), distances.end());
  EXPECT_LT(distances[distances.size() / 2], 0.002);
  EXPECT_LT(distances[distances.size() * 99 / 100], 0.012);
}

TEST_F(LaserMapTest, AWallBetweenTwoLayersOfCubesHasOneLayerOfPoints) {
  std::map<std::pair<int, int>, int> columns;  // y = 6 m is a face of voxels of 5 cm
  for (const MapPoint& point : mapPoints(trajectory_))
    if (std::abs(point.p.y() - 6.0F) < 0.03F && point.p.z() > 0.2F && point.p.z() < 3.8F)
      ++columns[{static_cast<int>(std::floor(point.p.x() / 0.05F)), static_cast<int>(std::floor(point.p.z() / 0.05F))}];
  ASSERT_GT(columns.size(), 2000U);
  std::size_t twice = 0;
  for (const auto& [column, points] : columns) twice += points > 1 ? 1 : 0;
  EXPECT_LT(twice, columns.size() / 50);
}

TEST_F(LaserMapTest, BytesDoNotDependOnTheNumberOfThreads) {
  std::string one, two;
  {
    const urban_nav_core::ThreadLimit limit(1);
    one = bytes(mapPoints(trajectory_));
  }
  forgetMap();
  {
    const urban_nav_core::ThreadLimit limit(2);
    two = bytes(mapPoints(trajectory_));
  }
  EXPECT_TRUE(one == two && one.size() > 1000);
}

TEST_F(LaserMapTest, ForgottenChunksAreRenderedAgain) {
  RenderStatistics statistics;
  const std::string before = bytes(mapPoints(trajectory_));
  forgetChunks(*store_, kRoomSession);
  EXPECT_TRUE(bytes(mapPoints(trajectory_, &statistics)) == before);
  EXPECT_EQ(statistics.chunks_rendered, statistics.chunks);
}

TEST_F(LaserMapTest, OnlyChunksThatMovedAreRenderedAgain) {
  RenderStatistics statistics;
  const std::string before = bytes(mapPoints(trajectory_, &statistics));
  EXPECT_EQ(statistics.chunks_rendered, statistics.chunks);
  EXPECT_GE(statistics.chunks, 5U);
  EXPECT_TRUE(bytes(mapPoints(trajectory_, &statistics)) == before);
  EXPECT_EQ(statistics.chunks_rendered, 0U);
  Trajectory moved;  // the second half by 3 cm
  for (const auto& pose : trajectory_)
    moved.append(pose.stamp, pose.stamp < trajectory_.front().stamp + 12'000'000'000
                                 ? pose.pose
                                 : Pose(pose.pose.q(), pose.pose.t() + Vector3d(0.03, 0.0, 0.0)));
  const std::string partly = bytes(mapPoints(moved, &statistics));
  EXPECT_GT(statistics.chunks_rendered, 0U);
  EXPECT_LT(statistics.chunks_rendered, statistics.chunks);
  forgetMap();
  EXPECT_TRUE(bytes(mapPoints(moved, &statistics)) == partly) << "equal to a new rendering";
}

TEST_F(LaserMapTest, BeamsWithoutAPoseAreCountedAndLeftOut) {
  Trajectory gap;
  for (const auto& pose : trajectory_) {
    const double t = urban_nav_core::secondsBetween(trajectory_.front().stamp, pose.stamp);
    if (t < 5.0 || t > 9.0) gap.append(pose.stamp, pose.pose);
  }
  RenderStatistics statistics;
  mapPoints(gap, &statistics);
  EXPECT_NEAR(static_cast<double>(statistics.beams.without_pose), 0.2 * static_cast<double>(statistics.beams.all),
              0.03 * static_cast<double>(statistics.beams.all));
}

TEST_F(LaserMapTest, UncertainPosesMakeUncertainPoints) {
  std::vector<Matrix6d> covariances(trajectory_.size(), Matrix6d::Zero());
  for (std::size_t i = 0; i < covariances.size(); ++i)  // a random walk along y, without its mean
    covariances[i](1, 1) = 0.02 * static_cast<double>(i) / static_cast<double>(covariances.size());
  const StampNs first = trajectory_.front().stamp;
  for (const MapPoint& point : mapPoints(trajectory_, nullptr, &covariances)) {
    const double t = urban_nav_core::secondsBetween(first, point.stamp) / 20.0;
    if (std::abs(point.normal.y()) > 0.99F) {
      EXPECT_NEAR(point.sigma, std::sqrt(0.02 * (1.0 / 3.0 - t + t * t)), 0.02);
    }
    if (point.normal.z() > 0.9999F) {
      EXPECT_LT(point.sigma, 0.02F);
    }
  }
}

TEST_F(LaserMapTest, ALaserWithoutExtrinsicsAndAPauseAreReported) {
  for (auto scan : testing_room::scansOfRoom(trajectory_, testing_room::roomLaser(), 0.005))
    if (scan.stamp < trajectory_.front().stamp + 5'000'000'000 || scan.stamp > trajectory_.back().stamp - 5'000'000'000)
      store_->scans().put(kRoomSession, "laser_right", scan);
  RenderStatistics statistics;
  mapPoints(trajectory_, &statistics);
  ASSERT_EQ(statistics.warnings.size(), 1U);
  EXPECT_EQ(statistics.warnings.front(), "scans of laser_right are ignored: its pose on the robot is unknown");
  store_->sessions().put(kRoomSession, urban_nav_store::Extrinsic{"laser_right", testing_room::roomLaser()});
  mapPoints(trajectory_, &statistics);
  ASSERT_EQ(statistics.warnings.size(), 1U);
  EXPECT_EQ(statistics.warnings.front(), "laser_right has no scans during 11 s of the rendered time");
}

TEST_F(LaserMapTest, AStoredMapHasTheBytesOfTheRenderedOne) {
  EXPECT_FALSE(storedMapParameters(*store_, kRoomSession));
  std::vector<Matrix6d> covariances;
  for (std::size_t i = 0; i < trajectory_.size(); ++i)
    covariances.push_back(Matrix6d::Identity() * 1e-6 * static_cast<double>(i));
  const std::vector<MapPoint> rendered = mapPoints(trajectory_, nullptr, &covariances);
  const auto parameters = storedMapParameters(*store_, kRoomSession);
  ASSERT_TRUE(parameters);
  EXPECT_EQ(parameters->voxel, Parameters().voxel);
  store_.reset();
  Store read(path_, urban_nav_store::Access::Read);
  LaserMap map(*parameters, read, {{kRoomSession, &trajectory_, nullptr}});
  map.load();
  std::vector<MapPoint> all;
  map.forEachTile(
      [&](const Tile&, const std::vector<MapPoint>& points) { all.insert(all.end(), points.begin(), points.end()); });
  EXPECT_TRUE(bytes(all) == bytes(rendered));
}

}  // namespace
}  // namespace laser_mapper
