// SPDX-License-Identifier: BSD-3-Clause
#include "camera/lens.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "camera/rig.hpp"
#include "noise/noise.hpp"
#include "rig/sensor_poses.hpp"

namespace urban_nav_sim {
namespace {

std::vector<Lens> lenses() {
  std::vector<Lens> all;
  for (const auto images : {StereoImages::Raw, StereoImages::Rectified}) {
    for (const Camera& camera : bumblebee(images)) all.push_back(camera.lens);
  }
  for (const Camera& camera : ladybug()) all.push_back(camera.lens);
  Lens odd = all[0];
  odd.distortion = {-0.25, 0.08, 0.002, -0.003, 0.01};
  all.push_back(odd);
  return all;
}

TEST(Lens, ProjectsAsOpenCvDoes) {
  const Noise noise(3, "points");
  for (const Lens& lens : lenses()) {
    const cv::Mat K = (cv::Mat_<double>(3, 3) << lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1);
    const std::vector<double> D(lens.distortion.begin(), lens.distortion.end());
    for (std::uint64_t i = 0; i < 200; ++i) {
      const double z = noise.uniform(3 * i, 0.5, 30.0);
      const Eigen::Vector3d p(z * noise.uniform(3 * i + 1, -0.6, 0.6), z * noise.uniform(3 * i + 2, -0.6, 0.6), z);
      std::vector<cv::Point2d> projected;
      cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), K, D,
                        projected);
      const auto pixel = lens.project(p);
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->x(), projected[0].x, 1e-6);
      EXPECT_NEAR(pixel->y(), projected[0].y, 1e-6);
    }
  }
}

TEST(Lens, EveryPixelHitsASurfaceAtItsProjection) {
  for (const Lens& lens : lenses()) {
    for (int v = 0; v <= lens.height; v += 16) {
      for (int u = 0; u <= lens.width; u += 16) {
        const auto ideal = lens.idealAt({u, v});
        ASSERT_TRUE(ideal) << u << " " << v;
        const auto pixel = lens.project({ideal->x(), ideal->y(), 1.0});
        ASSERT_TRUE(pixel);
        EXPECT_LT((*pixel - Eigen::Vector2d(u, v)).norm(), 1e-8);
      }
    }
  }
}

TEST(Lens, JacobianIsTheNumericOne) {
  const Lens lens = lenses().back();
  const Eigen::Vector2d at(0.43, -0.31);
  const Eigen::Matrix2d J = lens.distortionJacobian(at);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = 1e-6 * Eigen::Vector2d::Unit(i);
    EXPECT_LT(((lens.distorted(at + step) - lens.distorted(at - step)) / 2e-6 - J.col(i)).norm(), 1e-8);
  }
}

TEST(Lens, PointsNotInFrontOrFoldedAreNotProjected) {
  Lens lens = lenses().front();
  lens.distortion = {-0.3};
  EXPECT_FALSE(lens.project({0.1, 0.1, -1.0}));
  EXPECT_FALSE(lens.project({0.1, 0.1, 0.0}));
  EXPECT_FALSE(lens.project({1.5, 0.0, 1.0}));  // k1 < 0 bends it back into the image
  EXPECT_FALSE(lens.idealAt({5000.0, 0.0}));
  EXPECT_TRUE(lens.idealAt({400.0, 195.0}));
}

TEST(Rig, AgreesWithThePlacesOfTheSensors) {
  const auto stereo = bumblebee(StereoImages::Rectified);
  const auto T_base_left = sensorPose("stereo_left_optical_frame");
  EXPECT_TRUE(isApprox(T_base_left * stereo[1].T_head_camera, sensorPose("stereo_right_optical_frame"), 1e-9));
  EXPECT_NEAR(stereo[1].info.P(0, 3), -46.797, 1e-3);
  const urban_nav_core::Pose T_base_head(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, 1.4));
  const auto ring = ladybug();
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_TRUE(isApprox(T_base_head * ring[i].T_head_camera,
                         sensorPose("ladybug_camera" + std::to_string(i) + "_optical_frame"), 1e-9));
  }
}

TEST(Rig, RawImagesCoverWhatTheRectifiedOnesShow) {
  const auto raw = bumblebee(StereoImages::Raw), rectified = bumblebee(StereoImages::Rectified);
  for (std::size_t side = 0; side < 2; ++side) {
    int seen = 0, all = 0;
    for (int v = 0; v < 384; v += 8) {
      for (int u = 0; u < 512; u += 8, ++all) {
        const auto ideal = rectified[side].lens.idealAt({u, v});
        const auto pixel = raw[side].lens.project(raw[side].T_head_camera.R().transpose() *
                                                  Eigen::Vector3d(ideal->x(), ideal->y(), 1.0));
        seen += pixel && pixel->x() >= 0 && pixel->y() >= 0 && pixel->x() <= 511 && pixel->y() <= 383;
      }
    }
    EXPECT_GT(seen, 0.97 * all);
  }
}

}  // namespace
}  // namespace urban_nav_sim
