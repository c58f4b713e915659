// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/covariance_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace urban_nav_trust {
namespace {

double meanScale(const ScaleWeights& weights) {
  double mean = 0.0;
  for (std::size_t i = 0; i < kScaleCount; ++i) mean += weights[i] * covarianceScales()[i];
  return mean;
}

double probabilityAbove(const ScaleWeights& weights, double scale) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kScaleCount; ++i) sum += covarianceScales()[i] > scale ? weights[i] : 0.0;
  return sum;
}

TEST(CovarianceScale, WithoutEvidenceEachFactorFrom1To20IsAsLikely) {
  EXPECT_GT(covarianceScales().front(), 1.0);
  EXPECT_LT(covarianceScales().back(), 20.0);
  for (const double weight : ScaleEvidence().probabilities()) EXPECT_DOUBLE_EQ(weight, 1.0 / kScaleCount);
  EXPECT_TRUE(ScaleEvidence().isEmpty());
}

TEST(CovarianceScale, DifferencesFindTheFactor) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (const double scale : {1.5, 4.0, 12.0}) {
    ScaleEvidence evidence;
    for (int i = 0; i < 200; ++i) {
      Eigen::VectorXd difference(3);
      for (double& each : difference) each = std::hypot(0.1 * scale, 0.02) * normal(random);
      evidence.add(difference, 0.01 * Eigen::Matrix3d::Identity(), 0.0004 * Eigen::Matrix3d::Identity());
    }
    EXPECT_NEAR(std::log(meanScale(evidence.probabilities()) / scale), 0.0, 0.13) << "half a grid step";
  }
}

TEST(CovarianceScale, AMeasurementThatIsMuchCoarserThanOdometryIsLittleEvidence) {
  ScaleEvidence coarse, fine;
  for (int i = 0; i < 5; ++i) {
    coarse.add(Eigen::VectorXd::Zero(3), 1e-6 * Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity());
    fine.add(Eigen::VectorXd::Zero(3), 1e-6 * Eigen::Matrix3d::Identity(), 1e-8 * Eigen::Matrix3d::Identity());
  }
  EXPECT_NEAR(probabilityAbove(coarse.probabilities(), 5.0), probabilityAbove(ScaleEvidence().probabilities(), 5.0),
              1e-3);
  EXPECT_LT(probabilityAbove(fine.probabilities(), 2.0), 1e-3);
}

// Windows with less variation than sensors may have do not distinguish factors below that.
TEST(CovarianceScale, WindowsExcludeOnlyFactorsWhoseScatterWouldShow) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0.0, 1.0);
  WindowEvidence evidence(2e-3);
  for (int i = 0; i < 40; ++i) {
    double squares = 0.0;
    for (int axis = 0; axis < 3; ++axis) squares += std::pow(1e-3 * normal(random), 2);
    evidence.add(squares, 3.0, 1e-8, 1e-10);
  }
  const ScaleWeights weights = evidence.evidence().probabilities();
  EXPECT_LT(probabilityAbove(weights, 14.0), 0.01) << "0.1 mrad times 14 is more than the millirad that was seen";
  EXPECT_GT(probabilityAbove(weights, 5.0), 0.1);
  WindowEvidence without_drift(2e-3);
  without_drift.add(1e-6, 3.0, 0.0, 1e-6);
  EXPECT_TRUE(without_drift.evidence().isEmpty());
}

TEST(CovarianceScale, NumbersThatAreNoneAreNoEvidence) {
  ScaleEvidence evidence;
  evidence.add(Eigen::VectorXd::Constant(2, std::nan("")), Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity());
  evidence.add(Eigen::VectorXd::Zero(2), Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero());
  ScaleWeights none{};
  none[3] = std::nan("");
  evidence.add(none);
  EXPECT_TRUE(evidence.isEmpty());
}

TEST(CovarianceScale, TheLargerOfTwoFactorsIsDistributedAsDrawsAre) {
  ScaleWeights a{}, b{};
  a[2] = 0.3;
  a[7] = 0.7;
  b[4] = 0.5;
  b[9] = 0.5;
  const ScaleWeights larger = largerScale(a, b);
  EXPECT_NEAR(larger[4], 0.3 * 0.5, 1e-12);
  EXPECT_NEAR(larger[7], 0.7 * 0.5, 1e-12);
  EXPECT_NEAR(larger[9], 0.5, 1e-12);
  EXPECT_NEAR(std::accumulate(larger.begin(), larger.end(), 0.0), 1.0, 1e-12);
}

}  // namespace
}  // namespace urban_nav_trust
