// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/turned_right_camera.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace urban_nav_core {
namespace {

StereoCamera turnedCamera() { return {{300.0, 300.0, 191.5, 143.5, 384, 288}, 0.12, 1.5}; }

/// Grey level of the sky in a direction of the calibrated right camera.
double greyAlong(const Vector3d& ray) {
  const double x = ray.x() / ray.z(), y = ray.y() / ray.z();
  return 128.0 + 60.0 * std::sin(30.0 * x + 8.0 * y) + 50.0 * std::cos(20.0 * y - 5.0 * x);
}

/// Picture of a right camera that is turned by `turn`.
std::vector<std::uint8_t> renderSky(const StereoCamera& camera, const Vector3d& turn) {
  const Matrix3d R_calibrated_turned =
      Eigen::AngleAxisd(turn.norm(), turn.isZero() ? Vector3d::UnitX() : Vector3d(turn.normalized()))
          .toRotationMatrix();
  std::vector<std::uint8_t> pixels;
  for (int v = 0; v < camera.left.height; ++v)
    for (int u = 0; u < camera.left.width; ++u) {
      const Vector3d ray((u - (camera.left.cx - camera.disparity_offset)) / camera.left.fx,
                         (v - camera.left.cy) / camera.left.fy, 1.0);
      pixels.push_back(static_cast<std::uint8_t>(std::lround(greyAlong(R_calibrated_turned * ray))));
    }
  return pixels;
}

TEST(TurnedRightCamera, IsTheImageOfTheCalibratedCamera) {
  const StereoCamera camera = turnedCamera();
  const std::vector<std::uint8_t> wanted = renderSky(camera, Vector3d::Zero());
  for (const Vector3d& turn : {Vector3d(0.0, 0.01, 0.0), Vector3d(-0.008, 0.0, 0.0), Vector3d(0.004, -0.006, 0.012)}) {
    const std::vector<std::uint8_t> seen = renderSky(camera, turn);
    TurnedRightCamera right(camera);
    right.set(turn);
    std::vector<std::uint8_t> out;
    const ImageView corrected =
        right.correct({seen.data(), camera.left.width, camera.left.height, camera.left.width}, out);
    int worst = 0;
    for (int v = 10; v < camera.left.height - 10; ++v)
      for (int u = 10; u < camera.left.width - 10; ++u)
        worst =
            std::max(worst, std::abs(corrected.at(u, v) -
                                     static_cast<int>(wanted[static_cast<std::size_t>(v * camera.left.width + u)])));
    EXPECT_LE(worst, 2) << turn.transpose();
  }
}

TEST(TurnedRightCamera, PassesImagesUnchangedWithoutATurn) {
  const StereoCamera camera = turnedCamera();
  const std::vector<std::uint8_t> seen = renderSky(camera, Vector3d::Zero());
  std::vector<std::uint8_t> out;
  const ImageView image{seen.data(), camera.left.width, camera.left.height, camera.left.width};
  TurnedRightCamera right(camera);
  EXPECT_EQ(right.correct(image, out).data, image.data);
  right.set(Vector3d(0.0, 0.01, 0.0));
  const ImageView small{seen.data(), 100, 80, 100};
  EXPECT_EQ(right.correct(small, out).data, small.data);
  EXPECT_TRUE(right.correct({}, out).empty());
  right.set(Vector3d::Zero());
  EXPECT_EQ(right.correct(image, out).data, image.data);
}

}  // namespace
}  // namespace urban_nav_core
