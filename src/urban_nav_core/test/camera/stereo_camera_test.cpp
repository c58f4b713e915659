// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/stereo_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

namespace urban_nav_core {
namespace {

StereoCamera skewedCamera() { return {{389.5, 391.25, 254.75, 201.5, 512, 384}, 0.12}; }

TEST(StereoCamera, TriangulateInvertsProject) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> xy(-5.0, 5.0), z(0.3, 60.0);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(xy(random), xy(random), z(random));
    const auto pixel = skewedCamera().project(p);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR((*pixel)(0) - (*pixel)(2), 389.5 * 0.12 / p.z(), 1e-9);
    const auto back = skewedCamera().triangulate(*pixel);
    ASSERT_TRUE(back);
    EXPECT_TRUE(back->isApprox(p, 1e-9));
  }
}

TEST(StereoCamera, RightImageIsThatOfAPinholeAtTheBaseline) {
  const Eigen::Vector3d p(0.4, -0.2, 2.5);
  const auto right = skewedCamera().left.project(p - Eigen::Vector3d(0.12, 0.0, 0.0));
  const auto pixel = skewedCamera().project(p);
  EXPECT_NEAR((*pixel)(2), right->x(), 1e-12);
  EXPECT_NEAR((*pixel)(1), right->y(), 1e-12);
}

TEST(StereoCamera, JacobiansAreNumericDerivativesAndInverses) {
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.7, -1.3, 4.0), Eigen::Vector3d(-0.3, 0.2, 0.5)}) {
    const Eigen::Vector3d pixel = *skewedCamera().project(p);
    const Eigen::Matrix3d J = skewedCamera().projectJacobian(p);
    Eigen::Matrix3d numeric;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = Eigen::Vector3d::Unit(k) * 1e-6;
      numeric.col(k) = (*skewedCamera().project(p + step) - *skewedCamera().project(p - step)) / 2e-6;
    }
    EXPECT_LT((J - numeric).norm(), 1e-6 * J.norm());
    EXPECT_TRUE((skewedCamera().triangulateJacobian(pixel) * J).isApprox(Eigen::Matrix3d::Identity(), 1e-9));
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = Eigen::Vector3d::Unit(k) * 1e-4;
      numeric.col(k) = (*skewedCamera().triangulate(pixel + step) - *skewedCamera().triangulate(pixel - step)) / 2e-4;
    }
    EXPECT_LT((skewedCamera().triangulateJacobian(pixel) - numeric).norm(), 1e-6 * numeric.norm());
  }
}

TEST(StereoCamera, CovarianceIsThatOfSamples) {
  const Eigen::Vector3d p(0.7, -0.4, 3.0);
  const Eigen::Vector3d pixel = *skewedCamera().project(p);
  Eigen::Matrix3d L;
  L << 0.10, 0.0, 0.0, 0.02, 0.08, 0.0, 0.05, 0.0, 0.09;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Eigen::Matrix3d sampled = Eigen::Matrix3d::Zero();
  constexpr int kN = 20000;
  for (int i = 0; i < kN; ++i) {
    const Eigen::Vector3d d =
        *skewedCamera().triangulate(pixel + L * Eigen::Vector3d(normal(random), normal(random), normal(random))) - p;
    sampled += d * d.transpose() / kN;
  }
  const Eigen::Matrix3d expected = skewedCamera().triangulateCovariance(pixel, L * L.transpose());
  EXPECT_LT((sampled - expected).norm(), 0.05 * expected.norm());
}

TEST(StereoCamera, NoPointWithoutDisparity) {
  EXPECT_FALSE(skewedCamera().triangulate({100.0, 100.0, 100.0}));
  EXPECT_FALSE(skewedCamera().triangulate({100.0, 100.0, 101.0}));
  EXPECT_FALSE(skewedCamera().triangulate({100.0, 100.0, std::nan("")}));
  EXPECT_FALSE(skewedCamera().project({0.0, 0.0, -2.0}));
}

TEST(StereoCamera, ComparesAndPrints) {
  StereoCamera other = skewedCamera();
  other.baseline += 0.001;
  EXPECT_TRUE(isApprox(skewedCamera(), other, 0.002));
  EXPECT_FALSE(isApprox(skewedCamera(), other, 0.0005));
  std::ostringstream text;
  text << skewedCamera();
  EXPECT_EQ(text.str(), "512 x 384 px, fx = 389.5, fy = 391.25, cx = 254.75, cy = 201.5 px, baseline = 0.12 m");
}

}  // namespace
}  // namespace urban_nav_core
