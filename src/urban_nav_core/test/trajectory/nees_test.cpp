// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/nees.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "urban_nav_core/testing/bands.hpp"

namespace urban_nav_core {
namespace {

Matrix6d definiteCovariance() {
  Matrix6d A;
  for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = 0.01 * std::sin(1.0 + i * i);
  return A * A.transpose() + 1e-4 * Matrix6d::Identity();
}

TEST(Nees, OfOneSigmaAlongEachAxisIsSix) {
  const Vector6d sigma = (Vector6d() << 0.1, 0.2, 0.3, 0.01, 0.02, 0.0).finished() + Vector6d::Unit(5) * 1e-9;
  const PoseWithCovariance estimate{Pose(expSo3({0, 0, 1}), {1, 2, 3}), Matrix6d(sigma.cwiseAbs2().asDiagonal())};
  Vector6d d = Vector6d::Zero();
  d[0] = 0.1;
  EXPECT_NEAR(*nees(boxPlus(estimate.pose, d), estimate), 1.0, 1e-9);
  d = Vector6d::Zero();
  d[3] = 0.02;
  EXPECT_NEAR(*nees(boxPlus(estimate.pose, d), estimate), 4.0, 1e-9);
  EXPECT_NEAR(*neesRotation(boxPlus(estimate.pose, d), estimate), 4.0, 1e-9);
  EXPECT_NEAR(*neesTranslation(boxPlus(estimate.pose, d), estimate), 0.0, 1e-9);
}

TEST(Nees, HasTheMeanOfItsDimension) {
  const PoseWithCovariance estimate{Pose(expSo3({0.3, 0.2, 1}), {1, 2, 3}), definiteCovariance()};
  const Matrix6d L = estimate.covariance.llt().matrixL();
  std::mt19937 random(1);
  std::normal_distribution<double> n;
  double all = 0.0, translation = 0.0, rotation = 0.0;
  constexpr int kDraws = 500;
  for (int i = 0; i < kDraws; ++i) {
    Vector6d white;
    for (int k = 0; k < 6; ++k) white[k] = n(random);
    const Pose truth = boxPlus(estimate.pose, L * white);
    all += *nees(truth, estimate) / kDraws;
    translation += *neesTranslation(truth, estimate) / kDraws;
    rotation += *neesRotation(truth, estimate) / kDraws;
  }
  EXPECT_TRUE(testing::meanChiSquareFits(all, 6, kDraws));
  EXPECT_TRUE(testing::meanChiSquareFits(translation, 3, kDraws));
  EXPECT_TRUE(testing::meanChiSquareFits(rotation, 3, kDraws));
}

TEST(Nees, IsEmptyWithoutAProperCovariance) {
  EXPECT_FALSE(nees(Pose(), {Pose(), Matrix6d::Zero()}));
  Matrix6d bad = Matrix6d::Identity();
  bad(2, 2) = std::nan("");
  EXPECT_FALSE(nees(Pose(), {Pose(), bad}));
  EXPECT_FALSE(nees(Pose(), {Pose(), -Matrix6d::Identity()}));
}

TEST(Nees, OfATrajectoryIsRelativeToTheFirstPose) {
  const Pose world(expSo3({0.5, 0.1, -2}), {10, 20, 30});
  const Vector6d d = (Vector6d() << 0.1, 0, 0, 0, 0, 0).finished();
  std::vector<Pose> truth, estimate;
  std::vector<Matrix6d> covariances;
  for (int i = 0; i < 5; ++i) {
    const Pose relative(expSo3({0, 0, 0.1 * i}), {1.0 * i, 0, 0});
    estimate.push_back(relative);
    truth.push_back(world * (i == 0 ? relative : boxPlus(relative, d)));
    covariances.push_back(i == 0 ? Matrix6d(Matrix6d::Zero()) : Matrix6d(0.01 * Matrix6d::Identity()));
  }
  const NeesSummary summary = neesOfTrajectory(truth, estimate, covariances);
  EXPECT_EQ(summary.count, 4U);
  EXPECT_EQ(summary.left_out, 1U);
  EXPECT_NEAR(summary.mean, 1.0, 1e-9);
  EXPECT_NEAR(summary.mean_translation, 1.0, 1e-9);
  EXPECT_NEAR(summary.mean_rotation, 0.0, 1e-9);
  EXPECT_LT(summary.band.low, 6.0);
  EXPECT_GT(summary.band.high, 6.0);
  EXPECT_EQ(neesOfTrajectory({}, {}, {}).count, 0U);
}

}  // namespace
}  // namespace urban_nav_core
