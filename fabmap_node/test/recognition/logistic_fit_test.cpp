// SPDX-License-Identifier: BSD-3-Clause
#include "recognition/logistic_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace fabmap_node {
namespace {

/// Rows of independent evidence with an intercept; kinds drawn with the log odds that `truth` gives.
LogisticSamples drawRows(const Eigen::VectorXd& truth, int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&random] { return static_cast<double>(random() % 10000) / 10000.0; };
  LogisticSamples samples{Eigen::MatrixXd::Ones(count, truth.size()), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index k = 0; k + 1 < truth.size(); ++k) samples.x(i, k) = 4.0 * uniform() - 2.0;
    samples.target(i) = uniform() < logistic(samples.x.row(i).dot(truth)) ? 0.98 : 0.01;
    samples.weight(i) = 0.5 + uniform();
  }
  return samples;
}

double numericSlope(const LogisticSamples& samples, double penalty, Eigen::VectorXd at, Eigen::Index k) {
  constexpr double kStep = 1e-4;
  at(k) += kStep;
  const double above = logisticLoss(samples, penalty, at);
  at(k) -= 2.0 * kStep;
  return (above - logisticLoss(samples, penalty, at)) / (2.0 * kStep);
}

/// At the minimum the gradient of a free coefficient is zero, and that of one at its bound is not negative.
void expectMinimum(const LogisticSamples& samples, double penalty) {
  const Eigen::VectorXd fitted = fitLogistic(samples, penalty);
  ASSERT_TRUE(fitted.allFinite());
  for (Eigen::Index k = 0; k < fitted.size(); ++k) {
    const double slope = numericSlope(samples, penalty, fitted, k) / samples.weight.sum();
    const bool is_bounded = k + 1 < fitted.size();
    EXPECT_TRUE(fitted(k) >= 0.0 || !is_bounded);
    const double violation = is_bounded && fitted(k) == 0.0 ? std::min(0.0, slope) : slope;
    EXPECT_NEAR(violation, 0.0, 1e-6) << k << " penalty " << penalty;
  }
}

TEST(FitLogistic, IsAtTheMinimumForAnyPenalty) {
  const LogisticSamples samples = drawRows((Eigen::VectorXd(4) << 3.0, -1.0, 0.5, -2.0).finished(), 400, 3);
  for (const double penalty : {1e-4, 0.1, 10.0, 1e4}) expectMinimum(samples, penalty);
}

TEST(FitLogistic, IsAtTheMinimumWhereEvidenceSeparatesTheKinds) {
  LogisticSamples samples = drawRows((Eigen::VectorXd(3) << 2.0, 1.0, 0.0).finished(), 200, 4);
  for (Eigen::Index i = 0; i < samples.x.rows(); ++i)
    samples.x(i, 0) = samples.target(i) > 0.5 ? 5.0 + samples.x(i, 1) : samples.x(i, 1) - 5.0;
  for (const double penalty : {1e-5, 1.0}) expectMinimum(samples, penalty);
}

TEST(FitLogistic, CorrelatedEvidenceKeepsWhatTheFirstBoundHolds) {
  // The second column is negatively correlated with the place by itself, but positively given the first.
  LogisticSamples samples = drawRows((Eigen::VectorXd(3) << 3.0, 1.0, 0.0).finished(), 2000, 5);
  samples.x.col(1) = 0.7 * samples.x.col(1) - 0.7 * samples.x.col(0);
  expectMinimum(samples, 0.01);
  EXPECT_GT(fitLogistic(samples, 0.01)(1), 0.0);
}

TEST(FitLogistic, StrongPenaltyGivesTheMean) {
  const LogisticSamples samples = drawRows((Eigen::VectorXd(2) << 3.0, 0.0).finished(), 100, 6);
  EXPECT_LT(fitLogistic(samples, 1e9).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(FitLogistic, LossIsFiniteForLargeLogits) {
  const LogisticSamples samples = drawRows((Eigen::VectorXd(2) << 1.0, 0.0).finished(), 50, 7);
  EXPECT_TRUE(std::isfinite(logisticLoss(samples, 1.0, Eigen::VectorXd::Constant(2, 1e4))));
  EXPECT_EQ(logistic(1e4), 1.0);
  EXPECT_EQ(logistic(-1e4), 0.0);
}

}  // namespace
}  // namespace fabmap_node
