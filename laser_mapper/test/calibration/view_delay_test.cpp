// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/calibration/view_delay.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_registration::Picture;

constexpr int kDelayWidth = 240, kDelayHeight = 180, kDelayViews = 24;
constexpr float kWallDistance = 4.0F;

/// Brightness of the wall z = 4 m.
double paint(double x, double y) {
  return 120.0 + 35.0 * std::sin(9.0 * x + 2.0 * y) + 30.0 * std::sin(7.0 * y - 4.0 * x) + 20.0 * std::sin(17.0 * x);
}

/// The camera passes along the wall at 1.2 m/s, and turns.
Pose drivenPose(double t) {
  return Pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.25 * std::sin(1.1 * t), Eigen::Vector3d::UnitY())),
              Eigen::Vector3d(1.2 * t - 3.0, 0.0, 0.0));
}

ColourView viewAt(const Pose& pose, std::size_t image) {
  ColourView view;
  view.camera.pinhole = {150.0, 150.0, 120.0, 90.0, kDelayWidth, kDelayHeight};
  view.T_map_camera = pose;
  view.image = image;
  return view;
}

/// What the camera shows from a pose; each image has its own exposure.
Picture photograph(const Pose& pose, std::size_t image) {
  Picture picture{kDelayWidth, kDelayHeight, {}};
  const double exposure = 0.8 + 0.1 * static_cast<double>(image % 5);
  for (int v = 0; v < kDelayHeight; ++v)
    for (int u = 0; u < kDelayWidth; ++u) {
      const Eigen::Vector3d ray = pose.q() * Eigen::Vector3d((u - 120.0) / 150.0, (v - 90.0) / 150.0, 1.0);
      const Eigen::Vector3d p = pose.t() + kWallDistance / ray.z() * ray;
      const auto grey = static_cast<std::uint8_t>(std::clamp(exposure * paint(p.x(), p.y()), 0.0, 255.0));
      picture.bgr.insert(picture.bgr.end(), {grey, grey, grey});
    }
  return picture;
}

std::vector<MapPoint> wallPoints() {
  std::vector<MapPoint> points;
  for (float x = -5.0F; x < 5.0F; x += 0.05F)
    for (float y = -2.0F; y < 2.0F; y += 0.05F) {
      MapPoint point;
      point.p = {x, y, kWallDistance};
      point.normal = -Eigen::Vector3f::UnitZ();
      points.push_back(point);
    }
  return points;
}

/// Estimates the delay of images that were taken along `pose_at_time`, `late` seconds before their stamps.
ViewDelay delayOf(double late, const std::function<Pose(double)>& pose_at_time) {
  std::vector<ColourView> views;
  const auto stampOf = [](std::size_t view) { return 0.2 * static_cast<double>(view); };
  for (std::size_t i = 0; i < kDelayViews; ++i) views.push_back(viewAt(pose_at_time(stampOf(i)), i));
  ViewDelayEstimator estimator(
      views, [&](std::size_t view, double delay) { return std::optional(pose_at_time(stampOf(view) - delay)); }, 0.05);
  estimator.addSurface(wallPoints());
  return estimator.estimate([&](std::size_t image) { return photograph(pose_at_time(stampOf(image) - late), image); });
}

TEST(ViewDelay, LateImagesAreFound) {
  const ViewDelay found = delayOf(0.02, drivenPose);
  EXPECT_TRUE(found.delay.constrained);
  EXPECT_NEAR(found.delay.adopted, 0.02, 0.002);
  EXPECT_LT(std::abs(found.delay.value - 0.02), 4.0 * found.delay.sigma);
  EXPECT_LT(found.calibrated_spread, 0.7 * found.stated_spread);
}

TEST(ViewDelay, WhereNothingIsWrongNothingIsAdopted) {
  const ViewDelay found = delayOf(0.0, drivenPose);
  EXPECT_LT(std::abs(found.delay.value), std::max(3.0 * found.delay.sigma, 0.0005));
  EXPECT_EQ(found.delay.adopted, 0.0);
}

TEST(ViewDelay, ARobotThatStandsDoesNotTellIt) {
  const ViewDelay found = delayOf(0.02, [](double) { return drivenPose(1.0); });
  EXPECT_FALSE(found.delay.constrained);
  EXPECT_EQ(found.delay.adopted, 0.0);
}

TEST(ViewDelay, WithoutViewsThereIsNothing) {
  ViewDelayEstimator estimator(
      {}, [](std::size_t, double) { return std::nullopt; }, 0.05);
  EXPECT_FALSE(estimator.estimate([](std::size_t) { return Picture(); }).delay.constrained);
}

}  // namespace
}  // namespace laser_mapper
