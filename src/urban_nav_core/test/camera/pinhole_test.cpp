// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/pinhole.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/calib3d.hpp>
#include <random>
#include <sstream>

namespace urban_nav_core {
namespace {

Pinhole pinholeCamera() { return {389.5, 391.25, 254.75, 201.5, 512, 384}; }

TEST(Pinhole, AgreesWithOpenCv) {
  const Pinhole pinhole = pinholeCamera();
  const cv::Matx33d K(pinhole.fx, 0, pinhole.cx, 0, pinhole.fy, pinhole.cy, 0, 0, 1);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> xy(-5.0, 5.0), z(0.3, 60.0);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(xy(random), xy(random), z(random));
    std::vector<cv::Point2d> expected;
    cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), K,
                      cv::noArray(), expected);
    const auto pixel = pinhole.project(p);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), expected[0].x, 1e-9);
    EXPECT_NEAR(pixel->y(), expected[0].y, 1e-9);
  }
}

TEST(Pinhole, RayLeadsBackToThePoint) {
  const Pinhole pinhole = pinholeCamera();
  const Eigen::Vector3d p(0.7, -1.3, 4.0);
  EXPECT_TRUE((pinhole.ray(*pinhole.project(p)) * p.z()).isApprox(p, 1e-14));
}

TEST(Pinhole, JacobianIsTheNumericDerivative) {
  const Pinhole pinhole = pinholeCamera();
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.7, -1.3, 4.0), Eigen::Vector3d(-3.0, 2.0, 0.4)}) {
    const auto J = pinhole.projectJacobian(p);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = Eigen::Vector3d::Unit(k) * 1e-6;
      const Eigen::Vector2d numeric = (*pinhole.project(p + step) - *pinhole.project(p - step)) / 2e-6;
      EXPECT_TRUE(J.col(k).isApprox(numeric, 1e-7) || (J.col(k) - numeric).norm() < 1e-6) << J << "\n" << numeric;
    }
  }
}

TEST(Pinhole, NothingWithNegativeDepthOrAtTheCentre) {
  const Pinhole pinhole = pinholeCamera();
  EXPECT_FALSE(pinhole.project({0.1, 0.1, 0.0}));
  EXPECT_FALSE(pinhole.project({0.1, 0.1, -1.0}));
  EXPECT_FALSE(pinhole.project({0.1, 0.1, 1e-310}));
  EXPECT_FALSE(pinhole.project({0.1, 0.1, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(Pinhole, ContainsHalfAPixelAroundTheCentres) {
  const Pinhole pinhole = pinholeCamera();
  EXPECT_TRUE(pinhole.contains({-0.5, -0.5}));
  EXPECT_TRUE(pinhole.contains({511.49, 383.49}));
  EXPECT_FALSE(pinhole.contains({511.5, 0.0}));
  EXPECT_FALSE(pinhole.contains({0.0, -0.51}));
}

TEST(Pinhole, ComparesAndPrints) {
  Pinhole other = pinholeCamera();
  other.cx += 0.01;
  EXPECT_TRUE(isApprox(pinholeCamera(), other, 0.02));
  EXPECT_FALSE(isApprox(pinholeCamera(), other, 0.005));
  other.cx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isApprox(pinholeCamera(), other, 1e9));
  std::ostringstream text;
  text << pinholeCamera();
  EXPECT_EQ(text.str(), "512 x 384 px, fx = 389.5, fy = 391.25, cx = 254.75, cy = 201.5 px");
}

}  // namespace
}  // namespace urban_nav_core
