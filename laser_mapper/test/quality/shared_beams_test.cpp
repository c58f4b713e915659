// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/shared_beams.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/geometry/covariance_frames.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;

constexpr StampNs kSecond = 1'000'000'000, kDriveBegin = 1'225'719'872 * kSecond;

/// Along x at 1 m/s for 100 s: stretch n is from 4 n to 4 n + 4 m.
Trajectory driveStraight() {
  Trajectory trajectory;
  for (int i = 0; i <= 1000; ++i)
    trajectory.append(kDriveBegin + i * kSecond / 10,
                      Pose(Eigen::Quaterniond::Identity(), Vector3d(0.1 * i, 0.0, 0.0)));
  return trajectory;
}

urban_nav_core::Matrix6d informationOf(double sigma_m, double sigma_rad) {
  urban_nav_core::Vector6d information;
  information.head<3>().setConstant(1.0 / (sigma_m * sigma_m));
  information.tail<3>().setConstant(1.0 / (sigma_rad * sigma_rad));
  return information.asDiagonal();
}

/// Planes with an accuracy of 4 mm and 0.4 mrad between the middles of two stretches.
PlaneConstraint constraintBetween(std::int64_t stretch_a, std::int64_t stretch_b, std::size_t session_b = 0) {
  PlaneConstraint constraint;
  constraint.stretch_a = stretch_a;
  constraint.stretch_b = stretch_b;
  constraint.session_b = session_b;
  constraint.stamp_a = kDriveBegin + (4 * stretch_a + 2) * kSecond;
  constraint.stamp_b = kDriveBegin + (4 * stretch_b + 2) * kSecond;
  constraint.measured.information = informationOf(0.004, 0.0004);
  return constraint;
}

/// A closure by clouds at 20 and 80 m along the path.
CloudClosure closureByClouds(double sigma_m, double sigma_rad, std::size_t session_b = 0) {
  CloudClosure closure{0, session_b, kDriveBegin + 20 * kSecond, kDriveBegin + 80 * kSecond, {}};
  closure.measured.information = informationOf(sigma_m, sigma_rad);
  return closure;
}

PlaneConstraint discounted(const SharedBeams& beams, const PlaneConstraint& constraint) {
  return beams.discount({constraint}).front();
}

TEST(SharedBeamsTest, StretchesNearBothEndsOfAClosureShareItsBeams) {
  const Trajectory trajectory = driveStraight();
  const SharedBeams beams({&trajectory}, {closureByClouds(0.02, 0.002)}, 10.0);
  const auto isShared = [&](std::int64_t a, std::int64_t b) {
    return discounted(beams, constraintBetween(a, b)).is_shared;
  };
  EXPECT_TRUE(isShared(5, 20));
  EXPECT_TRUE(isShared(20, 5)) << "in either order";
  EXPECT_TRUE(isShared(7, 22)) << "28 to 32 m, of a cloud that ends at 30 m";
  EXPECT_FALSE(isShared(8, 20)) << "beyond the first cloud";
  EXPECT_FALSE(isShared(5, 6)) << "both in the first cloud";
  EXPECT_FALSE(isShared(1, 12)) << "far from both";
  EXPECT_FALSE(discounted(SharedBeams({&trajectory}, {}, 10.0), constraintBetween(5, 20)).is_shared);
}

TEST(SharedBeamsTest, AClosureTakesThePartOfItsInformationOnTheStretch) {
  const Trajectory trajectory = driveStraight();
  CloudClosure closure = closureByClouds(0.02, 0.002);
  closure.measured.information.bottomRightCorner<3, 3>().setZero();  // so that the lever has no part in it
  const SharedBeams beams({&trajectory}, {closure}, 10.0);
  const PlaneConstraint before = constraintBetween(5, 20), after = discounted(beams, before);
  const urban_nav_core::Matrix6d taken = before.measured.information - after.measured.information;
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(taken(i, i), 4.0 / 20.0 / (0.02 * 0.02), 1e-6) << "4 of the 20 m of the clouds";
  EXPECT_TRUE(isApprox(after.measured, {Pose(), after.measured.information}, 0.0))
      << "existing measurements are unchanged";
}

TEST(SharedBeamsTest, ConstraintsTogetherLoseAtMostTheInformationOfTheClosure) {
  const Trajectory trajectory = driveStraight();
  const SharedBeams beams({&trajectory}, {closureByClouds(0.02, 0.002)}, 10.0);
  std::vector<PlaneConstraint> constraints;
  for (std::int64_t a = 2; a < 8; ++a)
    for (std::int64_t b = 17; b < 23; ++b) constraints.push_back(constraintBetween(a, b));
  double taken = 0.0;
  const auto after = beams.discount(constraints);
  for (std::size_t i = 0; i < after.size(); ++i)
    taken += constraints[i].measured.information(0, 0) - after[i].measured.information(0, 0);
  EXPECT_NEAR(taken, 1.0 / (0.02 * 0.02), 0.1 / (0.02 * 0.02));
}

TEST(SharedBeamsTest, NothingRemainsOfWhatAClosureMeasuresBetter) {
  const Trajectory trajectory = driveStraight();
  const SharedBeams strong({&trajectory}, {closureByClouds(1e-4, 1e-5)}, 10.0);
  EXPECT_TRUE(discounted(strong, constraintBetween(5, 20)).measured.information.isZero(0.0));
  // A closure with information in one direction only: planes keep theirs in the others.
  CloudClosure across = closureByClouds(1e-4, 1e-5);
  across.measured.information.setZero();
  across.measured.information(1, 1) = 1e10;
  PlaneConstraint same_poses = constraintBetween(5, 20);
  same_poses.stamp_a = across.stamp_a;
  same_poses.stamp_b = across.stamp_b;
  const urban_nav_core::Matrix6d left =
      discounted(SharedBeams({&trajectory}, {across}, 10.0), same_poses).measured.information;
  EXPECT_LT(left(1, 1), 1.0);
  EXPECT_NEAR(left(0, 0), 1.0 / (0.004 * 0.004), 1.0);
  EXPECT_NEAR(left(2, 2), 1.0 / (0.004 * 0.004), 1.0);
}

TEST(SharedBeamsTest, InformationIsCarriedWithItsLeverInEitherOrder) {
  // Lateral position and heading at 80 m together determine the position at 82 m.
  const Trajectory trajectory = driveStraight();
  const SharedBeams beams({&trajectory}, {closureByClouds(0.02, 0.002)}, 10.0);
  const PlaneConstraint constraint = constraintBetween(5, 20), reversed = constraintBetween(20, 5);
  const auto taken = [&](const PlaneConstraint& from) {
    return urban_nav_core::Matrix6d(from.measured.information - discounted(beams, from).measured.information);
  };
  const double share = 4.0 / 20.0, lever = 2.0, across = share / (0.02 * 0.02), heading = share / (0.002 * 0.002);
  EXPECT_NEAR(taken(constraint)(1, 5), -lever * across, 1e-6 * across);
  EXPECT_NEAR(taken(constraint)(5, 5), heading + lever * lever * across, 1e-6 * heading);
  const Pose T_b_a(Eigen::Quaterniond::Identity(), Vector3d(-60.0, 0.0, 0.0));
  const urban_nav_core::Matrix6d expected =
      urban_nav_core::transformInformation(urban_nav_core::invert(T_b_a).J, taken(constraint));
  EXPECT_LT((taken(reversed) - expected).norm(), 1e-6 * expected.norm());
}

TEST(SharedBeamsTest, SessionsAreDistinguished) {
  const Trajectory monday = driveStraight(), tuesday = driveStraight();
  const SharedBeams beams({&monday, &tuesday}, {closureByClouds(0.02, 0.002, 1)}, 10.0);
  EXPECT_TRUE(discounted(beams, constraintBetween(5, 20, 1)).is_shared);
  EXPECT_FALSE(discounted(beams, constraintBetween(20, 5, 1)).is_shared);
  EXPECT_FALSE(discounted(beams, constraintBetween(5, 20, 0)).is_shared);
}

TEST(SharedBeamsTest, TheLengthOfThePathCountsNotTheTime) {
  Trajectory waiting = driveStraight();
  for (int i = 1; i <= 100; ++i)
    waiting.append(kDriveBegin + (100 + i) * kSecond, waiting.back().pose);  // 100 s at 100 m
  CloudClosure closure = closureByClouds(0.02, 0.002);
  closure.stamp_b = kDriveBegin + 190 * kSecond;
  const SharedBeams beams({&waiting}, {closure}, 10.0);
  EXPECT_TRUE(discounted(beams, constraintBetween(5, 23)).is_shared) << "92 to 96 m";
  EXPECT_FALSE(discounted(beams, constraintBetween(5, 21)).is_shared) << "84 to 88 m";
}

}  // namespace
}  // namespace laser_mapper
