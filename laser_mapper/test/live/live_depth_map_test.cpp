// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <string>

#include "laser_mapper/sensors.hpp"
#include "live/live_map.hpp"
#include "support/rendered_depth.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pinhole;
using urban_nav_core::Pose;

const char* const kDepthFrame = "camera_depth_optical_frame";

/// Map of the room by a camera that faces ahead.
class LiveDepthMap : public ::testing::Test {
 protected:
  /// `measure`: adds what the camera measures at a pose.
  template <typename Measure>
  void drive(const Measure& measure) {
    for (std::size_t i = 0; i < trajectory_.size(); ++i) {
      map_.addOdometry(trajectory_[i]);
      measure(i);
    }
  }
  void addImage(std::size_t i) {
    map_.addDepth(kDepthFrame, trajectory_[i].stamp, camera_, [this, i] {
      ++decoded_;
      return depthAt(i);
    });
  }
  void addView(std::size_t i) {
    const urban_nav_store::DepthView row = testing_room::depthOfScene(
        testing_room::rangeInRoom, trajectory_[i].pose, trajectory_[i].stamp, 0.1F, static_cast<unsigned>(i));
    const urban_nav_store::DepthView::Samples samples = row.samples();
    map_.addView(row.stamp,
                 {row.fx, row.fy, row.cx, row.cy, row.baseline, static_cast<int>(row.step), samples.width,
                  samples.height, samples.disparity, samples.sigma, samples.grey},
                 row.T_base_camera);
  }
  /// Depths as those of a camera of 160x120 px.
  cv::Mat depthAt(std::size_t i) const {
    cv::Mat depth(kHeight, kWidth, CV_32FC1);
    const Pose T_room_camera = trajectory_[i].pose * testing_room::roomCamera();
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        const testing_room::Vector3d ray((u - camera_.cx) / camera_.fx, (v - camera_.cy) / camera_.fy, 1.0);
        depth.at<float>(v, u) = static_cast<float>(
            testing_room::rangeInRoom(T_room_camera.t(), T_room_camera.q() * ray.normalized()) / ray.norm());
      }
    return depth;
  }
  void expectRoom(std::uint8_t sensor, double median) {
    std::vector<double> errors;
    for (const MapPoint& point : map_.render()) {
      ASSERT_EQ(point.laser, sensor);
      errors.push_back(testing_room::distanceToRoom(point.p.cast<double>()));
    }
    ASSERT_GT(errors.size(), 2000U);
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], median);
    EXPECT_LT(errors[errors.size() * 99 / 100], 0.12);
  }

  static constexpr int kWidth = 160, kHeight = 120;
  const Pinhole camera_ = [] {
    Pinhole pinhole;
    pinhole.fx = pinhole.fy = 130.0;
    pinhole.cx = 79.5;
    pinhole.cy = 59.5;
    pinhole.width = kWidth;
    pinhole.height = kHeight;
    return pinhole;
  }();
  const urban_nav_core::Trajectory trajectory_ = testing_room::driveThroughRoom(6.0);
  int decoded_ = 0;
  LiveMap map_{Parameters(), ::testing::TempDir() + "live_depth_map_" + std::to_string(::getpid()) + ".db", 10.0};
};

TEST_F(LiveDepthMap, ADepthCameraAloneMakesAMap) {
  map_.sensors().placeDepthCamera(kDepthFrame, testing_room::roomCamera());
  drive([this](std::size_t i) { addImage(i); });
  const std::size_t stored = map_.counts().sensors.depth_images;
  EXPECT_GE(stored, 8U);
  EXPECT_LE(stored, 20U) << "3 m: an image about every 0.25 m or 6 deg";
  EXPECT_EQ(static_cast<std::size_t>(decoded_), stored) << "no other image is decoded";
  expectRoom(depthSensor(0), 0.01);
}

TEST_F(LiveDepthMap, ImagesThatCannotBeUsedAreCounted) {
  map_.sensors().placeDepthCamera(kDepthFrame, testing_room::roomCamera());
  drive([this](std::size_t i) { map_.addDepth(kDepthFrame, trajectory_[i].stamp, camera_, [] { return cv::Mat(); }); });
  EXPECT_EQ(map_.counts().sensors.depth_images, 0U);
  EXPECT_GE(map_.counts().sensors.invalid_depth, 8U);
  EXPECT_TRUE(map_.render().empty());
}

TEST_F(LiveDepthMap, ImagesWithoutAMountingAreCounted) {
  drive([this](std::size_t i) { addImage(i); });
  EXPECT_EQ(map_.counts().sensors.unplaced, trajectory_.size());
  EXPECT_EQ(decoded_, 0);
}

TEST_F(LiveDepthMap, DenseStereoAloneMakesAMap) {
  drive([this](std::size_t i) { addView(i); });
  EXPECT_GE(map_.counts().sensors.stereo_views, 8U);
  expectRoom(kStereoSensor, 0.02);
  map_.clear();
  EXPECT_TRUE(map_.render().empty());
}

TEST_F(LiveDepthMap, DenseStereoIsNotUsedWithALaserThatMeasuresSurfaces) {
  map_.sensors().placeLaser("laser_left", Pose());
  EXPECT_FALSE(map_.sensors().hasTiltedLaser()) << "horizontal: one height alone";
  drive([this](std::size_t i) { addView(i); });
  EXPECT_GT(map_.counts().sensors.stereo_views, 0U);
  map_.clear();
  map_.sensors().placeLaser("laser_right", testing_room::roomLaser());
  EXPECT_TRUE(map_.sensors().hasTiltedLaser());
  drive([this](std::size_t i) { addView(i); });
  EXPECT_EQ(map_.counts().sensors.stereo_views, 0U);
}

}  // namespace
}  // namespace laser_mapper
