// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/position_probability.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "urban_nav_core/trajectory/chi_square.hpp"

namespace urban_nav_trust {
namespace {

TEST(PositionProbability, OfOneTwoAndThreeEqualAxesIsChiSquare) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  for (int axes = 1; axes <= 3; ++axes)
    for (const double sigma : {0.001, 0.03, 0.2, 1.0, 40.0})
      for (const double radius : {0.1, 0.5, 2.0}) {
        Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
        covariance.diagonal().head(axes).setConstant(sigma * sigma);
        const double x = radius * radius / (sigma * sigma);
        EXPECT_NEAR(probabilityWithin(radius, R * covariance * R.transpose()),
                    urban_nav_core::chiSquareProbability(x, axes), 1e-4)
            << axes << " axes of " << sigma << " m, " << radius << " m";
      }
}

TEST(PositionProbability, OfDifferentAxesIsTheShareOfDraws) {
  const Eigen::Vector3d sigma(0.02, 0.4, 0.9);
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  const int draws = 200000;
  int within = 0;
  for (int i = 0; i < draws; ++i)
    within +=
        Eigen::Vector3d(sigma[0] * normal(random), sigma[1] * normal(random), sigma[2] * normal(random)).norm() < 0.5;
  const double p = probabilityWithin(0.5, sigma.cwiseAbs2().asDiagonal().toDenseMatrix());
  EXPECT_NEAR(p, static_cast<double>(within) / draws, 4.0 * std::sqrt(p * (1.0 - p) / draws));
}

TEST(PositionProbability, OfNothingUncertainIsOneAndOfNoNumberZero) {
  EXPECT_EQ(probabilityWithin(0.1, Eigen::Matrix3d::Zero()), 1.0);
  Eigen::Matrix3d bad = Eigen::Matrix3d::Identity();
  bad(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(probabilityWithin(0.1, bad), 0.0);
}

}  // namespace
}  // namespace urban_nav_trust
