// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_files.hpp"
#include "support/scanned_room.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/near_points.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_store::NearPoints;
using urban_nav_store::Store;

constexpr const char* kFillSession = "0123456789abcdef0123";

/// The room of scanned_room.hpp: the laser measures its left half, dense stereo the floor on both sides of the path.
class StereoFill : public ::testing::Test {
 protected:
  StereoFill() {
    path_ = ::testing::TempDir() + "stereo_fill_test.db";
    urban_nav_store::removeStore(path_);
    store_ = std::make_unique<Store>(path_, urban_nav_store::Access::Write);
    store_->sessions().put(urban_nav_store::Session{kFillSession, "room", "", "", 1, true});
    store_->sessions().put(kFillSession, urban_nav_store::Extrinsic{"laser_left", testing_room::roomLaser()});
    for (const auto& scan : testing_room::scansOfRoom(trajectory_, testing_room::roomLaser(), 0.005))
      store_->scans().put(kFillSession, "laser_left", scan);
    for (std::size_t i = 0; i < trajectory_.size(); i += 10) putFloor(i);
    store_->commit();
  }
  ~StereoFill() override {
    store_.reset();
    urban_nav_store::removeStore(path_);
  }

  /// Points of the floor 1 to 4 m ahead, every fifth of them invalid.
  void putFloor(std::size_t pose, float sigma = 0.02F) {
    std::mt19937 random(static_cast<unsigned>(pose));
    std::normal_distribution<float> noise(0.0F, 0.3F * sigma);
    std::vector<NearPoints::Point> points;
    for (float x = 1.0F; x < 4.0F; x += 0.06F)
      for (float y = -3.0F; y < 3.0F; y += 0.06F) {
        const bool is_useless = points.size() % 5 == 4;
        points.push_back({{x, y, is_useless ? 0.7F : noise(random)}, is_useless ? 0.2F : sigma, 90});
      }
    NearPoints row;
    row.session = kFillSession;
    row.stamp = trajectory_[pose].stamp;
    row.camera = {0.3, 0.1, 1.1};
    row.pixel_angle = 0.002;
    row.packed = NearPoints::pack(points);
    urban_nav_store::TableStore<NearPoints>(*store_).put(row);
  }

  std::vector<MapPoint> mapPoints(bool stereo, RenderStatistics* statistics = nullptr) {
    Parameters parameters;
    parameters.stereo = stereo;
    LaserMap map(parameters, *store_, {{kFillSession, &trajectory_, nullptr}});
    const RenderStatistics rendered = map.render();
    if (statistics != nullptr) *statistics = rendered;
    std::vector<MapPoint> all;
    map.forEachTile(
        [&](const Tile&, const std::vector<MapPoint>& points) { all.insert(all.end(), points.begin(), points.end()); });
    return all;
  }

  static bool isStereo(const MapPoint& point) { return point.laser == 255; }

  const Trajectory trajectory_ = testing_room::driveThroughRoom(12.0);
  std::string path_;
  std::unique_ptr<Store> store_;
};

TEST_F(StereoFill, FillsTheFloorThatNoLaserMeasured) {
  std::vector<double> errors;
  for (const MapPoint& point : mapPoints(true)) {
    if (!isStereo(point)) continue;
    errors.push_back(std::abs(static_cast<double>(point.p.z())));
    EXPECT_GT(point.normal.z(), 0.9F);
    EXPECT_GT(point.sigma, 0.0025F) << "an eighth of that along the line of sight";
    EXPECT_LT(point.sigma, 0.03F);
    EXPECT_EQ(point.red, 90);
    EXPECT_LT(std::abs(point.p.y()), 3.8F);
  }
  ASSERT_GT(errors.size(), 3000U);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() * 95 / 100], 0.02);
  EXPECT_LT(errors.back(), 0.1) << "uncertain points are omitted";
}

TEST_F(StereoFill, AddsNothingWhereALaserMeasured) {
  const std::vector<MapPoint> points = mapPoints(true);
  std::size_t checked = 0;
  for (std::size_t i = 0; i < points.size(); i += 7) {
    if (!isStereo(points[i])) continue;
    ++checked;
    for (const MapPoint& other : points)
      if (!isStereo(other)) {
        ASSERT_GT((other.p - points[i].p).norm(), 0.15F);
      }
  }
  EXPECT_GT(checked, 300U);
}

TEST_F(StereoFill, TheLasersPointsAreTheSameWithoutIt) {
  std::string with, without;
  for (const MapPoint& point : mapPoints(true))
    if (!isStereo(point)) appendVertex(with, point);
  for (const MapPoint& point : mapPoints(false)) {
    EXPECT_FALSE(isStereo(point));
    appendVertex(without, point);
  }
  EXPECT_TRUE(with == without);
}

TEST_F(StereoFill, NewPointsOfStereoRenderTheirChunkAgain) {
  RenderStatistics statistics;
  mapPoints(true, &statistics);
  mapPoints(true, &statistics);
  EXPECT_EQ(statistics.chunks_rendered, 0U);
  putFloor(0, 0.03F);
  mapPoints(true, &statistics);
  EXPECT_EQ(statistics.chunks_rendered, 1U);
}

}  // namespace
}  // namespace laser_mapper
