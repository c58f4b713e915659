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
  // A lower row implies a column further to the right.
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

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

/// A wall 8 m in front of a camera, and a landmark on it.
struct Wall {
  Wall() {
    camera.left.fx = camera.left.fy = 400.0;
    camera.left.cx = 256.0;
    camera.left.cy = 192.0;
    camera.left.width = 512;
    camera.left.height = 384;
    camera.baseline = 0.12;
    track.plane = Vector3d(0.0, 0.0, 1.0 / 8.0);
    match.track = &track;
    match.p_odom << 0.0, 0.0, 8.0, 1.0;
    match.left.found = true;
    match.left.covariance = 0.01 * Eigen::Matrix2d::Identity();
  }
  static Pose forward(double metres) { return Pose(Eigen::Quaterniond::Identity(), Vector3d(0.0, 0.0, -metres)); }

  urban_nav_core::StereoCamera camera;
  Track track;
  Match match;
};

TEST(TemplateDrift, IsNothingWhereTheViewStays) {
  Wall wall;
  EXPECT_NEAR(creep(wall.camera, wall.forward(0.0), wall.match).norm(), 0.0, 1e-12);
  EXPECT_GT(creep(wall.camera, wall.forward(1.0), wall.match).trace(), 0.0);
  EXPECT_NEAR(creep(wall.camera, wall.forward(1.0), wall.match).norm(), 0.0, 1e-12);
}

TEST(TemplateDrift, IsLargerWhereThePatchFitsWorse) {
  Wall good, bad;
  bad.match.left.covariance = 0.25 * Eigen::Matrix2d::Identity();
  const double of_good = creep(good.camera, good.forward(1.0), good.match).trace();
  EXPECT_GT(creep(bad.camera, bad.forward(1.0), bad.match).trace(), 10.0 * of_good);
}

TEST(TemplateDrift, IsThatOfTheRightImageWhereTheLeftHasNone) {
  Wall wall, other;
  other.match.right = other.match.left;
  other.match.left.found = false;
  other.match.left.covariance *= 100.0;
  EXPECT_NEAR(
      (creep(wall.camera, wall.forward(1.0), wall.match) - creep(other.camera, other.forward(1.0), other.match)).norm(),
      0.0, 1e-12);
}

TEST(TemplateDrift, OfAViewTwiceAsLargeIsAQuarterWhereBorn) {
  Wall wall;
  creep(wall.camera, wall.forward(4.0), wall.match);
  const Eigen::Matrix2d born = whereBorn(wall.track, Eigen::Matrix2d::Identity());
  EXPECT_NEAR((born - 0.25 * Eigen::Matrix2d::Identity()).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace swf_vo
