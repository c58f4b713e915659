// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/term_selection.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace laser_mapper {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Estimate of one laser with these standard deviations, all terms independent.
TermEstimate independent(const VectorXd& mean, const VectorXd& sigmas) {
  return {mean, sigmas.cwiseAbs2().asDiagonal(), sigmas};
}

TEST(TermSelection, OnlyWhatDiffersFromZeroIsChosen) {
  VectorXd mean = VectorXd::Zero(7), sigmas = VectorXd::Constant(7, 1e-3);
  mean << 0.010, 0.001, -0.001, 0.0005, 0.001, -0.001, 0.0;
  EXPECT_EQ(significantTerms(independent(mean, sigmas)),
            (std::vector<bool>{true, false, false, false, false, false, false}));
  mean(5) = 0.01;
  EXPECT_EQ(significantTerms(independent(mean, sigmas)),
            (std::vector<bool>{true, false, false, false, true, true, true}));
  EXPECT_EQ(significantTerms(independent(VectorXd::Zero(7), sigmas)), std::vector<bool>(7, false));
}

TEST(TermSelection, TermsObservableOnlyAsASumAreNotDroppedTogether) {
  // Delay and shift z are each uncertain, but their sum is significantly non-zero.
  MatrixXd information = MatrixXd::Identity(7, 7) * 1e6;
  information(0, 0) = information(3, 3) = 1e6 + 400.0;
  information(0, 3) = information(3, 0) = 1e6;
  TermEstimate estimate;
  estimate.covariance = information.inverse();
  estimate.mean = VectorXd::Zero(7);
  estimate.mean(0) = estimate.mean(3) = 0.02;
  estimate.conditional_sigma = information.diagonal().cwiseSqrt().cwiseInverse();
  const std::vector<bool> chosen = significantTerms(estimate);
  EXPECT_NE(chosen[0], chosen[3]) << "one of them explains the measurements";
}

TEST(TermSelection, NamesWhatIsNotConstrained) {
  MountedLaser laser{"laser_left", {}, 0};
  Eigen::Matrix3d R;  // x to the left, y up, z forward
  R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  laser.T_base_laser = urban_nav_core::Pose(R, Eigen::Vector3d::Zero());
  VectorXd sigmas = VectorXd::Constant(7, 1e-3);
  sigmas(2) = 0.05;
  sigmas(0) = 0.05;
  const auto sentences = describeUnconstrained(independent(VectorXd::Zero(7), sigmas), {laser});
  EXPECT_EQ(sentences, (std::vector<std::string>{"delay of laser_left", "shift of laser_left along its y axis (up)"}));
}

}  // namespace
}  // namespace laser_mapper
