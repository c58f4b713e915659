// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/information.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <sstream>

namespace urban_nav_core {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Blocks 7 (2), 3 (1), 9 (3), all correlated.
Information linked() {
  Information information({{7, 2}, {3, 1}, {9, 3}});
  MatrixXd A(6, 6);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) A(i, j) = std::cos(1.0 + 5.0 * i + 3.0 * j * j);
  }
  information.add({7, 3, 9}, A * A.transpose() + MatrixXd::Identity(6, 6), VectorXd::LinSpaced(6, -1.0, 2.0));
  return information;
}

TEST(Information, AddPutsBlocksInTheirPlaces) {
  Information information({{7, 2}, {3, 1}});
  MatrixXd H(3, 3);
  H << 1, 2, 3, 2, 4, 5, 3, 5, 6;
  information.add({3, 7}, H, Eigen::Vector3d(10, 20, 30));
  EXPECT_EQ(information.H(3, 3)(0, 0), 1.0);
  EXPECT_EQ(information.H(7, 7), MatrixXd(H.bottomRightCorner(2, 2)));
  EXPECT_EQ(information.H(7, 3), MatrixXd(H.bottomLeftCorner(2, 1)));
  EXPECT_EQ(information.b(7), VectorXd(Eigen::Vector2d(20, 30)));
  EXPECT_EQ(information.offset(3), 2);
  EXPECT_TRUE(information.contains(3));
  EXPECT_FALSE(information.contains(4));
}

TEST(Information, AddingAGaussianAppendsItsNewBlocks) {
  Information a({{1, 1}});
  a.add({1}, MatrixXd::Constant(1, 1, 2.0), VectorXd::Constant(1, 1.0));
  Information b({{5, 1}, {1, 1}});
  b.add({5, 1}, MatrixXd::Identity(2, 2), VectorXd::Ones(2));
  a.add(b);
  EXPECT_EQ(a.blocks().size(), 2U);
  EXPECT_EQ(a.H(1, 1)(0, 0), 3.0);
  EXPECT_EQ(a.H(5, 5)(0, 0), 1.0);
  EXPECT_EQ(a.b(1)[0], 2.0);
}

TEST(Information, PermutingTwiceIsNothing) {
  const Information a = linked();
  const Information b = a.permuted({9, 7, 3});
  EXPECT_EQ(b.H(7, 9), a.H(7, 9));
  EXPECT_EQ(b.offset(9), 0);
  EXPECT_TRUE(isApprox(b.permuted({7, 3, 9}), a, 0.0));
  EXPECT_FALSE(isApprox(a, b, 1e9));
}

TEST(Information, TheMarginalOfAGaussianIsItsBlock) {
  const Information a = linked();
  const auto marginal = a.marginalised({3, 7});
  ASSERT_TRUE(marginal);
  const MatrixXd covariance = a.H().inverse();
  EXPECT_LE((marginal->H().inverse() - covariance.bottomRightCorner(3, 3)).norm(), 1e-12);
  EXPECT_LE((*marginal->mean() - a.mean()->tail(3)).norm(), 1e-12);
  EXPECT_LE((*a.covariance(9) - covariance.bottomRightCorner(3, 3)).norm(), 1e-12);
}

TEST(Information, TheOrderOfMarginalisingDoesNotMatter) {
  const Information a = linked();
  EXPECT_TRUE(isApprox(*a.marginalised({3})->marginalised({7}), *a.marginalised({7, 3}), 1e-12));
}

TEST(Information, WhatWasNeverObservedTakesNothingAway) {
  Information a = linked();
  a.append({4, 2});
  EXPECT_TRUE(isApprox(*a.marginalised({4}), linked(), 1e-12));
}

TEST(Information, ADirectionThatStaysFreeKeepsZeroInformation) {
  Information a({{1, 1}, {2, 1}});  // a relative measurement alone
  MatrixXd H(2, 2);
  H << 4, -4, -4, 4;
  a.add({1, 2}, H, Eigen::Vector2d(-1, 1));
  EXPECT_FALSE(a.mean());
  EXPECT_FALSE(a.covariance(1));
  EXPECT_NEAR(a.marginalised({1})->H()(0, 0), 0.0, 1e-15);
}

TEST(Information, ConditioningAgreesWithTheCovarianceForm) {
  const Information a = linked();
  const VectorXd value = Eigen::Vector2d(0.3, -0.7);
  const Information given = a.conditioned(7, value);
  const MatrixXd P = a.H().inverse();
  const VectorXd mean = *a.mean();
  const MatrixXd gain = P.bottomLeftCorner(4, 2) * P.topLeftCorner(2, 2).inverse();
  EXPECT_LE((*given.mean() - (mean.tail(4) + gain * (value - mean.head(2)))).norm(), 1e-12);
  EXPECT_LE((given.H().inverse() - (P.bottomRightCorner(4, 4) - gain * P.topRightCorner(2, 4))).norm(), 1e-12);
}

TEST(Information, RefusesToMarginaliseNaN) {
  Information a = linked();
  a.add({3}, MatrixXd::Constant(1, 1, NAN), VectorXd::Zero(1));
  EXPECT_FALSE(a.marginalised({7}));
}

TEST(Information, PrintsItself) {
  std::ostringstream out;
  out << Information({{7, 1}, {3, 1}});
  EXPECT_EQ(out.str(), "information over 7(1) 3(1):\nH =\n0 0\n0 0\nb = 0 0");
}

}  // namespace
}  // namespace urban_nav_core
