// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_files.hpp"
#include "laser_mapper/sensors.hpp"
#include "support/lidar_sweeps.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/depth_image.hpp"
#include "urban_nav_store/tables/ground_view.hpp"
#include "urban_nav_store/tables/mounted_lidar.hpp"

namespace laser_mapper {
namespace {

using testing_room::Scene;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_store::Store;
using urban_nav_store::TableStore;

constexpr const char* kSensorSession = "0123456789abcdef4567";

/// A box of 0.6 m that crosses the room in front of the robot within two seconds.
Scene roomWithBox(double seconds) {
  return [y = 4.0 - 4.0 * seconds](const Vector3d& origin, const Vector3d& direction) {
    const double wall = testing_room::rangeInRoom(origin, direction), t = (5.0 - origin.x()) / direction.x();
    const Vector3d at = origin + t * direction;
    return t > 0.0 && std::abs(at.y() - y) < 0.3 && at.z() > 0.5 && at.z() < 1.7 ? std::min(t, wall) : wall;
  };
}

/// Maps of the room of scanned_room.hpp by sensors other than planar lasers.
class SensorsMap : public ::testing::Test {
 protected:
  SensorsMap() {
    path_ = ::testing::TempDir() + "sensors_map_test.db";
    urban_nav_store::removeStore(path_);
    store_ = std::make_unique<Store>(path_, urban_nav_store::Access::Write);
    store_->sessions().put(urban_nav_store::Session{kSensorSession, "room", "", "", 1, true});
  }
  ~SensorsMap() override {
    store_.reset();
    urban_nav_store::removeStore(path_);
  }

  void putDepth(std::size_t pose, const Scene& scene) {
    urban_nav_store::DepthView view = testing_room::depthOfScene(scene, trajectory_[pose].pose, trajectory_[pose].stamp,
                                                                 0.2F, static_cast<unsigned>(pose));
    view.session = kSensorSession;
    TableStore<urban_nav_store::DepthView>(*store_).put(view);
    urban_nav_store::GroundView ground;
    ground.session = kSensorSession;
    ground.stamp = view.stamp;
    TableStore<urban_nav_store::GroundView>(*store_).put(ground);
  }
  /// An image of a depth camera with the error that the parameter depth_sigma states.
  void putDepthImage(std::size_t pose, const std::string& role) {
    constexpr float kFocalBaselineOfView = 260.0F * 0.25F;
    const auto sigma = static_cast<float>(Parameters().depth_sigma) * kFocalBaselineOfView;
    urban_nav_store::DepthView view = testing_room::depthOfScene(
        testing_room::rangeInRoom, trajectory_[pose].pose, trajectory_[pose].stamp, sigma, static_cast<unsigned>(pose));
    urban_nav_store::DepthView::Samples samples = view.samples();
    for (float& disparity : samples.disparity)
      disparity *= static_cast<float>(urban_nav_store::DepthImage::kFocalBaseline) / kFocalBaselineOfView;
    std::fill(samples.sigma.begin(), samples.sigma.end(), 1.0F / 64.0F);
    TableStore<urban_nav_store::DepthImage>(*store_).put(
        {kSensorSession, role, view.stamp, "depth_optical_frame", view.step, view.fx, view.fy, view.cx, view.cy,
         view.T_base_camera, urban_nav_store::DepthView::pack(samples)});
  }
  void putSweep(urban_nav_core::StampNs reference, const Scene& scene) {
    TableStore<urban_nav_store::MountedLidar>(*store_).put(
        {kSensorSession, "points0", "velodyne", testing_room::roomLidar()});
    TableStore<urban_nav_store::LidarSweep>(*store_).put(
        {kSensorSession, "points0", reference,
         urban_nav_store::LidarSweep::pack(testing_room::sweepOfScene(scene, trajectory_, reference))});
  }

  std::vector<MapPoint> mapPoints(RenderStatistics* statistics = nullptr, const Parameters& parameters = Parameters()) {
    LaserMap map(parameters, *store_, {{kSensorSession, &trajectory_, nullptr}});
    const RenderStatistics rendered = map.render();
    if (statistics != nullptr) *statistics = rendered;
    std::vector<MapPoint> all;
    map.forEachTile(
        [&](const Tile&, const std::vector<MapPoint>& points) { all.insert(all.end(), points.begin(), points.end()); });
    return all;
  }
  static std::vector<double> distancesToRoom(const std::vector<MapPoint>& points) {
    std::vector<double> errors;
    for (const MapPoint& point : points) errors.push_back(testing_room::distanceToRoom(point.p.cast<double>()));
    std::sort(errors.begin(), errors.end());
    return errors;
  }
  std::vector<std::string> header() const { return mapLayout(storedSensors(*store_, {kSensorSession})).comments; }

  const Trajectory trajectory_ = testing_room::driveThroughRoom(6.0);
  std::string path_;
  std::unique_ptr<Store> store_;
};

TEST_F(SensorsMap, DepthImagesAloneMakeAMap) {
  for (std::size_t i = 0; i < trajectory_.size(); i += 10) putDepth(i, testing_room::rangeInRoom);
  const std::vector<MapPoint> points = mapPoints();
  ASSERT_GT(points.size(), 3000U);
  const std::vector<double> errors = distancesToRoom(points);
  EXPECT_LT(errors[errors.size() / 2], 0.02);
  EXPECT_LT(errors[errors.size() * 99 / 100], 0.12);
  for (const MapPoint& point : points) {
    ASSERT_EQ(point.laser, kStereoSensor);
    ASSERT_FALSE(point.is_coloured);
    ASSERT_NEAR(point.normal.norm(), 1.0F, 1e-4F);
    ASSERT_GT(point.sigma, 0.0F);
  }
  EXPECT_EQ(header().back(), "sensor 255 stereo stereo_left_optical_frame");
}

TEST_F(SensorsMap, ADepthCameraMakesAMapWithItsOwnSensorId) {
  for (std::size_t i = 0; i < trajectory_.size(); i += 10) putDepthImage(i, "depth1");
  const std::vector<MapPoint> points = mapPoints();
  ASSERT_GT(points.size(), 3000U);
  const std::vector<double> errors = distancesToRoom(points);
  EXPECT_LT(errors[errors.size() / 2], 0.01);
  EXPECT_LT(errors[errors.size() * 99 / 100], 0.06);
  for (const MapPoint& point : points) ASSERT_EQ(point.laser, depthSensor(1));
  EXPECT_EQ(header().back(), "sensor 124 depth1 depth_optical_frame");
  EXPECT_EQ(missingMeasurements(*store_, kSensorSession), "");
}

TEST_F(SensorsMap, ALargerErrorOfADepthCameraIsInThePoints) {
  for (std::size_t i = 0; i < trajectory_.size(); i += 10) putDepthImage(i, "depth0");
  const auto median = [](const std::vector<MapPoint>& points) {
    std::vector<float> sigmas;
    for (const MapPoint& point : points) sigmas.push_back(point.sigma);
    std::nth_element(sigmas.begin(), sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2), sigmas.end());
    return sigmas[sigmas.size() / 2];
  };
  const float stated = median(mapPoints());
  Parameters coarse;
  coarse.depth_sigma *= 2.0;
  EXPECT_GT(median(mapPoints(nullptr, coarse)), 1.5F * stated) << "the chunks are rendered again";
}

TEST_F(SensorsMap, TwoDepthImagesAreNotEnough) {
  putDepth(0, testing_room::rangeInRoom);
  putDepth(10, testing_room::rangeInRoom);
  EXPECT_TRUE(mapPoints().empty());
}

TEST_F(SensorsMap, NewDepthImagesRenderTheChunksAroundThemAgain) {
  for (std::size_t i = 0; i < trajectory_.size(); i += 10) putDepth(i, testing_room::rangeInRoom);
  RenderStatistics statistics;
  mapPoints(&statistics);
  const std::size_t chunks = statistics.chunks_rendered;
  mapPoints(&statistics);
  EXPECT_EQ(statistics.chunks_rendered, 0U);
  putDepth(5, testing_room::rangeInRoom);
  mapPoints(&statistics);
  EXPECT_GT(statistics.chunks_rendered, 0U);
  EXPECT_LE(statistics.chunks_rendered, chunks);
}

TEST_F(SensorsMap, SweepsMakeAMapWithoutWhatMoved) {
  for (int i = 0; i < 54; ++i) {
    const urban_nav_core::StampNs reference = testing_room::kRoomStart + 200'000'000 + i * 100'000'000LL;
    putSweep(reference, roomWithBox(0.1 * i));
  }
  const std::vector<MapPoint> points = mapPoints();
  ASSERT_GT(points.size(), 20'000U);
  const std::vector<double> errors = distancesToRoom(points);
  EXPECT_LT(errors[errors.size() / 2], 0.005);
  EXPECT_LT(errors[errors.size() * 99 / 100], 0.05);
  std::size_t moved = 0;
  for (const double error : errors) moved += error > 0.3 ? 1 : 0;
  EXPECT_LT(moved, 20U) << "of the box";
  for (const MapPoint& point : points) ASSERT_EQ(point.laser, kFirstLidar);
  EXPECT_EQ(header().back(), "sensor 32 points0 velodyne");
}

TEST_F(SensorsMap, DepthImagesFillWhatSweepsDidNotMeasure) {
  const Scene above_the_floor = [](const Vector3d& origin, const Vector3d& direction) {
    return direction.z() < -0.1 ? 0.0 : testing_room::rangeInRoom(origin, direction);
  };
  for (int i = 0; i < 54; i += 4) putSweep(testing_room::kRoomStart + 200'000'000 + i * 100'000'000LL, above_the_floor);
  for (std::size_t i = 0; i < trajectory_.size(); i += 10) putDepth(i, testing_room::rangeInRoom);
  std::size_t lidar = 0, stereo = 0;
  for (const MapPoint& point : mapPoints()) ++(point.laser == kStereoSensor ? stereo : lidar);
  EXPECT_GT(lidar, 5'000U);
  EXPECT_GT(stereo, 500U);
  EXPECT_EQ(header().size(), 3U);
}

TEST_F(SensorsMap, NamesWhatIsMissing) {
  EXPECT_EQ(missingMeasurements(*store_, kSensorSession),
            "no laser scans, sweeps of a 3D LiDAR, images of a depth camera or of dense stereo");
  putDepth(0, testing_room::rangeInRoom);
  EXPECT_EQ(missingMeasurements(*store_, kSensorSession), "");
}

TEST(SensorIds, FollowFramesAndRoles) {
  EXPECT_EQ(planarSensor("laser_left", 1), 0);
  EXPECT_EQ(planarSensor("laser_right", 0), 1);
  EXPECT_EQ(planarSensor("base_scan", 3), 5);
  EXPECT_EQ(planarSensor("base_scan", 300), kFirstLidar - 1);
  EXPECT_EQ(lidarSensor("points0"), kFirstLidar);
  EXPECT_EQ(lidarSensor("points3"), kFirstLidar + 3);
  for (const char* other : {"points", "points-1", "points9999", "scan"}) EXPECT_EQ(lidarSensor(other), kLastLidar);
}

}  // namespace
}  // namespace laser_mapper
