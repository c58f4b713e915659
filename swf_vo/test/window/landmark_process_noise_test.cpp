// SPDX-License-Identifier: BSD-3-Clause
#include "window/landmark_process_noise.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace swf_vo {
namespace {

Eigen::MatrixXd full(const Prior& prior) {
  Eigen::MatrixXd M(prior.size(), prior.size());
  for (int j = 0; j < prior.size(); ++j)
    for (int i = j; i < prior.size(); ++i) M(i, j) = M(j, i) = prior.information(i, j);
  return M;
}

// A prior of 11 landmarks and a pose with arbitrary information of full rank.
Prior somePrior(bool offset) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Prior prior;
  prior.has_pose = true;
  for (int i = 0; i < 11; ++i) prior.slots.push_back(i);
  const int n = prior.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
  A = (A * A.transpose()).eval();
  prior.information.reset(n);
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i) prior.information(i, j) = A(i, j);
  for (int i = 0; i < n; ++i) {
    prior.eta.push_back(normal(random));
    prior.border.push_back(normal(random));
  }
  prior.has_offset = offset;
  prior.offset_information = 500.0;
  prior.offset_eta = 0.7;
  return prior;
}

TEST(LandmarkProcessNoise, AddsItsCovarianceToThatOfTheBlocksThatMovedAndNothingToTheMean) {
  Prior prior = somePrior(true);
  const int n = prior.size();
  const Eigen::MatrixXd before = full(prior);
  const auto joint = [n](const Prior& p, Eigen::VectorXd& mean) {
    Eigen::MatrixXd M(n + 1, n + 1);
    M.topLeftCorner(n, n) = full(p);
    M.col(n).head(n) = Eigen::Map<const Eigen::VectorXd>(p.border.data(), n);
    M.row(n).head(n) = M.col(n).head(n).transpose();
    M(n, n) = p.offset_information;
    Eigen::VectorXd eta(n + 1);
    eta << Eigen::Map<const Eigen::VectorXd>(p.eta.data(), n), p.offset_eta;
    const Eigen::MatrixXd covariance = M.inverse();
    mean = covariance * eta;
    return covariance;
  };
  Eigen::VectorXd mean_before, mean_after;
  Eigen::MatrixXd expected = joint(prior, mean_before);
  std::vector<LandmarkProcessNoise::Step> steps;
  for (const int block : {0, 1, 2, 3, 4, 6, 7, 8, 9, 10}) {  // more than one group
    Eigen::Matrix2d Q;
    Q << 0.3 + 0.1 * block, 0.05, 0.05, 0.2;
    steps.push_back({block, Q});
    expected.block<2, 2>(3 * block, 3 * block) += Q;
  }
  Departed departed;
  departed.gain.assign(static_cast<std::size_t>(6 * n), 0.0);
  const std::vector<double> directions(static_cast<std::size_t>(6 * n), 0.0);
  LandmarkProcessNoise template_drift_covariance;
  template_drift_covariance.apply(steps, directions, prior, departed);
  const Eigen::MatrixXd got = joint(prior, mean_after);
  EXPECT_LT((got - expected).norm(), 1e-8 * expected.norm());
  EXPECT_LT((mean_after - mean_before).norm(), 1e-8 * mean_before.norm());
  EXPECT_GT((full(prior) - before).norm(), 1e-3) << "something has happened";
}

TEST(LandmarkProcessNoise, KeepsTheCrossTermsOfTheMarginalisedPose) {
  // d_left = gain d + offset_gain o, with d before the step; expressed in d + w it has the same covariance with it.
  Prior prior = somePrior(false);
  const int n = prior.size();
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  Departed departed;
  for (int i = 0; i < 6 * n; ++i) departed.gain.push_back(normal(random));
  std::vector<double> directions;
  for (int i = 0; i < 6 * n; ++i) directions.push_back(normal(random));
  const Eigen::MatrixXd P = full(prior).inverse();
  const Eigen::MatrixXd gain = Eigen::Map<const Eigen::MatrixXd>(departed.gain.data(), n, 6);
  const Eigen::MatrixXd G = Eigen::Map<const Eigen::MatrixXd>(directions.data(), n, 6);
  const Eigen::MatrixXd gauge_before = G.transpose() * full(prior) * G;
  departed.gauge_gain = gain.transpose() * G;
  LandmarkProcessNoise template_drift_covariance;
  template_drift_covariance.apply({{3, 0.5 * Eigen::Matrix2d::Identity()}, {8, 0.2 * Eigen::Matrix2d::Identity()}},
                                  directions, prior, departed);
  const Eigen::MatrixXd after = Eigen::Map<const Eigen::MatrixXd>(departed.gain.data(), n, 6);
  const Eigen::MatrixXd P_after = full(prior).inverse();
  EXPECT_LT((after.transpose() * P_after - gain.transpose() * P).norm(), 1e-8 * (gain.transpose() * P).norm());
  EXPECT_LT((departed.gauge_gain - after.transpose() * G).norm(), 1e-8 * departed.gauge_gain.norm());
  const Eigen::MatrixXd gauge_after = G.transpose() * full(prior) * G;
  EXPECT_LT((gauge_before - gauge_after - departed.gauge_loss).norm(), 1e-8 * gauge_before.norm());
}

}  // namespace
}  // namespace swf_vo
