// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/refine.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace swf_vo {
namespace {

Match pairAt(double row_left, double row_right) {
  Match match;
  match.left.found = match.right.found = true;
  match.left.pixel = {100.0, row_left};
  match.right.pixel = {90.0, row_right};
  match.left.covariance << 0.02, 0.0, 0.0, 0.01;
  match.right.covariance << 0.03, 0.0, 0.0, 0.04;
  return match;
}

TEST(Combine, WeighsTheRowByBothImages) {
  Match match = pairAt(50.0, 50.1);
  combine(0.0, match);
  ASSERT_TRUE(match.measured);
  EXPECT_NEAR(match.z.x(), 100.0, 1e-12);
  EXPECT_NEAR(match.z.z(), 90.0, 1e-12);
  EXPECT_NEAR(match.z.y(), 50.02, 1e-12);
  const Eigen::Matrix3d R = match.information.inverse();
  EXPECT_NEAR(R(0, 0), 0.02, 1e-12);
  EXPECT_NEAR(R(1, 1), 0.008, 1e-12);
  EXPECT_NEAR(R(2, 2), 0.03, 1e-12);
}

TEST(Combine, TheRowsDifferenceMovesThePlaceAlongAnEdge) {
  Match match = pairAt(50.0, 50.2);
  match.left.covariance << 0.10, 0.09, 0.09, 0.10;
  combine(0.0, match);
  ASSERT_TRUE(match.measured);
  // A row further down goes with a column further right.
  EXPECT_GT(match.z.y(), 50.0);
  EXPECT_GT(match.z.x(), 100.05);
}

TEST(Combine, TheFloorIsAddedToEachCoordinate) {
  Match match = pairAt(50.0, 50.0);
  combine(0.1, match);
  const Eigen::Matrix3d R = match.information.inverse();
  EXPECT_NEAR(R(0, 0), 0.03, 1e-12);
  EXPECT_NEAR(R(2, 2), 0.04, 1e-12);
}

TEST(Combine, RowsThatContradictEachOtherAreNoMeasurement) {
  Match match = pairAt(50.0, 52.0);
  combine(0.05, match);
  EXPECT_FALSE(match.measured);
}

TEST(Combine, RowsAreTheLeftImages) {
  Match match = pairAt(50.0, 52.1), right_only = pairAt(50.0, 52.1);
  combine(0.0, match, 2.0);
  ASSERT_TRUE(match.measured);
  EXPECT_NEAR(match.z.y(), 50.02, 1e-12);
  EXPECT_NEAR(match.z.x(), 100.0, 1e-12);
  right_only.left.found = false;
  combine(0.0, right_only, 2.0);
  EXPECT_NEAR(right_only.z.y(), 50.1, 1e-12);
}

TEST(Combine, OneImageLeavesTheOtherCoordinateWithoutInformation) {
  Match match = pairAt(50.0, 50.0);
  match.right.found = false;
  combine(0.0, match);
  ASSERT_TRUE(match.measured);
  EXPECT_EQ(match.information.row(2).norm(), 0.0);
  EXPECT_EQ(match.information.col(2).norm(), 0.0);
  EXPECT_NEAR(match.information(0, 0), 50.0, 1e-9);
  match.left.found = false;
  combine(0.0, match);
  EXPECT_FALSE(match.measured);
}

TEST(InverseDepth, IsThatInTheFirstCamera) {
  Track track;
  track.T_born_odom = urban_nav_core::Pose(urban_nav_core::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, 2.0));
  Match match;
  match.track = &track;
  match.p_odom = {1.0, 2.0, 3.0, 1.0};
  EXPECT_NEAR(inverseDepthWhereBorn(match), 0.2, 1e-12);
  match.p_odom = {1.0, 2.0, 3.0, 0.0};
  EXPECT_EQ(inverseDepthWhereBorn(match), 0.0);
}

}  // namespace
}  // namespace swf_vo
