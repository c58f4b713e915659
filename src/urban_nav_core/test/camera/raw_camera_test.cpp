// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/raw_camera.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "support/opencv.hpp"

namespace urban_nav_core {
namespace {

RawCamera plumbBob() {
  return {{458.654, 457.296, 367.215, 248.375, 752, 480},
          Distortion({-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0, 0.0, 0.0, 0.0})};
}

RawCamera rational() {
  return {{610.0, 612.5, 330.25, 243.75, 640, 480},
          Distortion({0.45, -0.11, 0.0003, -0.0002, 0.013, 0.80, 0.05, 0.002})};
}

TEST(RawCamera, AgreesWithOpenCvOverTheImage) {
  for (const RawCamera& camera : {plumbBob(), rational()}) {
    std::vector<cv::Point2d> pixels;
    for (int v = 0; v < 480; v += 13) {
      for (int u = 0; u < camera.pinhole.width; u += 13) pixels.emplace_back(u, v);
    }
    std::vector<cv::Point2d> ideal, seen;
    cv::undistortPoints(pixels, ideal, K(camera.pinhole), D(camera.distortion), cv::noArray(), cv::noArray(),
                        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 500, 1e-12));
    std::vector<cv::Point3d> points;
    for (const cv::Point2d& p : ideal) points.emplace_back(p.x * 3.0, p.y * 3.0, 3.0);
    cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), K(camera.pinhole), D(camera.distortion), seen);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const auto ray = camera.ray({pixels[i].x, pixels[i].y});
      ASSERT_TRUE(ray);
      EXPECT_NEAR(ray->x() * camera.pinhole.fx, ideal[i].x * camera.pinhole.fx, 1e-6);
      EXPECT_NEAR(ray->y() * camera.pinhole.fy, ideal[i].y * camera.pinhole.fy, 1e-6);
      const auto pixel = camera.project({points[i].x, points[i].y, points[i].z});
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->x(), seen[i].x, 1e-6);
      EXPECT_NEAR(pixel->y(), seen[i].y, 1e-6);
    }
  }
}

TEST(RawCamera, ProjectsNoPointsWithNegativeDepth) {
  EXPECT_FALSE(plumbBob().project({0.1, 0.1, -1.0}));
  EXPECT_FALSE(plumbBob().project({0.1, 0.1, 0.0}));
}

}  // namespace
}  // namespace urban_nav_core
