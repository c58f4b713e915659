// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_localization/localiser.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_localization {
namespace {

using urban_nav_core::Constraint;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

constexpr StampNs kSightingSecond = 1'000'000'000;

Pose poseAt(double x, double y = 0.0, double heading = 0.0) {
  return Pose(urban_nav_core::expSo3({0.0, 0.0, heading}), {x, y, 0.0});
}

/// A robot that drives a metre a second along x of the map from (10, 5).
class LocaliserTest : public ::testing::Test {
 protected:
  void drive(int seconds, double sigma_m = 0.01, urban_nav_core::Health health = urban_nav_core::Health::Ok) {
    for (int i = 0; i < seconds; ++i) {
      urban_nav_core::RelativePose step;
      step.from = now_ * kSightingSecond;
      step.to = ++now_ * kSightingSecond;
      step.T_from_to = poseAt(1.0);
      step.status.health = health;
      step.covariance.setZero();
      step.covariance.diagonal() << Eigen::Vector3d::Constant(sigma_m * sigma_m), Eigen::Vector3d::Constant(1e-6);
      ASSERT_TRUE(localiser_.addOdometry(step));
    }
  }
  static Pose truth(double seconds) { return poseAt(10.0 + seconds, 5.0); }
  /// Adds a match with a place of the map 2 m to the side, with the error `error` in the map.
  void see(int second, const Pose& error = Pose(), double sigma_m = 0.02) {
    const Pose T_map_a = poseAt(11.0 + second, 7.0, 1.0);
    Constraint measured;
    measured.T_a_b = T_map_a.inverse() * error * truth(second);
    measured.information.diagonal() << Eigen::Vector3d::Constant(1.0 / (sigma_m * sigma_m)),
        Eigen::Vector3d::Constant(1e6);
    localiser_.addMatch(second * kSightingSecond, T_map_a, measured);
  }
  void expectRight(double metres) const {
    const LocalizationEstimate estimate = localiser_.now();
    EXPECT_EQ(estimate.state, LocalizationState::Localized) << estimate.sentence;
    ASSERT_TRUE(estimate.T_map_base);
    EXPECT_LT(distanceBetween(estimate.T_map_base->pose, truth(static_cast<double>(now_))), metres);
  }

  Localiser localiser_{Parameters()};
  StampNs now_ = 0;
};

TEST_F(LocaliserTest, IsUnsureAtFirst) {
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
  drive(3);
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
  EXPECT_FALSE(localiser_.now().T_map_base);
}

TEST_F(LocaliserTest, OneMatchIsAHypothesisAndTwoConsistentOnesAreKnown) {
  drive(3);
  see(1);
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
  EXPECT_TRUE(localiser_.now().T_map_base);
  see(3);
  expectRight(0.01);
  drive(5);
  expectRight(0.01);
}

TEST_F(LocaliserTest, TheSamePlaceTwiceCountsOnce) {
  drive(3);
  see(3);
  see(3);
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
}

TEST_F(LocaliserTest, OneFalseMatchMovesNothing) {
  drive(8);
  for (const int second : {1, 3, 5}) see(second);
  see(7, poseAt(20.0, -3.0));
  expectRight(0.01);
}

TEST_F(LocaliserTest, FalseOnesThatDisagreeWithEachOtherAreNeverKnown) {
  urban_nav_core::testing::Dice dice(4);
  drive(20);
  for (int second = 1; second < 20; second += 2)
    see(second, poseAt(dice.uniform(-30.0, 30.0), dice.uniform(-30.0, 30.0), dice.uniform(-3.0, 3.0)));
  EXPECT_NE(localiser_.now().state, LocalizationState::Localized);
}

TEST_F(LocaliserTest, TwoHypothesesWithAsManyWitnessesAreUnsure) {
  drive(8);
  see(1);
  see(3);
  see(5, poseAt(20.0));
  see(7, poseAt(20.0));
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
  drive(2);
  see(9);
  expectRight(0.02);
}

TEST_F(LocaliserTest, OdometryWearsOut) {
  drive(3);
  see(1);
  see(3);
  drive(400, 0.03);
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
  ASSERT_TRUE(localiser_.now().T_map_base);
  const LocalizationEstimate before = localiser_.at(4 * kSightingSecond);
  EXPECT_EQ(before.state, LocalizationState::Localized);
}

TEST_F(LocaliserTest, MatchesOverManyPlacesAreFusedWithACorrectCovariance) {
  urban_nav_core::testing::Dice dice(9);
  drive(20);
  for (int second = 1; second <= 20; ++second) see(second, poseAt(0.05 * dice.normal(), 0.05 * dice.normal()), 0.05);
  expectRight(0.05);
  EXPECT_LT(std::sqrt(localiser_.now().T_map_base->covariance(0, 0)), 0.08);
  EXPECT_GT(std::sqrt(localiser_.now().T_map_base->covariance(0, 0)), 0.01);
}

TEST_F(LocaliserTest, FailedComparisonsAreANewPlace) {
  drive(5);
  for (const int second : {1, 2, 3}) localiser_.addMiss(second * kSightingSecond, false);
  EXPECT_EQ(localiser_.now().state, LocalizationState::Unmapped);
  see(4);
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
}

TEST_F(LocaliserTest, ARobotThatWasCarriedElsewhereIsFoundAgain) {
  drive(40);
  for (int second = 1; second <= 30; ++second) see(second);
  expectRight(0.02);
  const Pose elsewhere = poseAt(35.0, -12.0);
  see(32, elsewhere);
  expectRight(0.3);  // one may be false
  see(34, elsewhere);
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::Contested);
  see(36, elsewhere);
  EXPECT_EQ(localiser_.now().state, LocalizationState::Localized) << localiser_.now().sentence;
  ASSERT_TRUE(localiser_.now().T_map_base);
  EXPECT_LT(distanceBetween(localiser_.now().T_map_base->pose, elsewhere * truth(40)), 0.05);
  see(38);  // and what was forgotten does not come back with one
  EXPECT_LT(distanceBetween(localiser_.now().T_map_base->pose, elsewhere * truth(40)), 0.05);
}

TEST_F(LocaliserTest, FalseMatchesBetweenTrueOnesHaveNoEffect) {
  drive(40);
  for (int second = 1; second <= 40; ++second)
    see(second, second > 30 && second % 3 != 0 ? poseAt(35.0, -12.0) : Pose());
  see(40);
  EXPECT_LT(distanceBetween(localiser_.now().T_map_base->pose, truth(40)), 0.05);
}

TEST_F(LocaliserTest, AMissingExpectedMatchEndsKnown) {
  drive(12);
  for (const int second : {1, 3, 5}) see(second);
  for (const int second : {6, 7, 8, 9}) localiser_.addMiss(second * kSightingSecond, false);
  expectRight(0.02);  // the map may show nothing of this place
  for (const int second : {10, 11}) localiser_.addMiss(second * kSightingSecond, true);
  expectRight(0.02);
  localiser_.addMiss(12 * kSightingSecond, true);
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::NotConfirmed);
  see(12);
  expectRight(0.02);
}

TEST_F(LocaliserTest, LostOdometryEndsLocalizedUntilAMatchConfirmsThePose) {
  drive(6);
  for (const int second : {1, 3, 5}) see(second);
  expectRight(0.02);
  drive(1, 0.02, urban_nav_core::Health::Lost);
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::OdometryLost);
  EXPECT_TRUE(localiser_.now().T_map_base) << "the prediction helps to search";
  see(7);
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::OdometryLost) << "the pose itself is still a prediction";
  drive(2, 0.02, urban_nav_core::Health::Lost);
  drive(1, 0.01, urban_nav_core::Health::Recovered);
  drive(5, 0.01);
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::OdometryLost) << "good odometry starts from a predicted pose";
  see(13, poseAt(6.0, -2.0));
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::OdometryLost) << "this match contradicts it";
  see(14);
  expectRight(0.05);
  EXPECT_EQ(localiser_.at(5 * kSightingSecond).state, LocalizationState::Localized);
  EXPECT_EQ(localiser_.at(8 * kSightingSecond).reason, LocalizationReason::OdometryLost) << "a lost frame";
  EXPECT_EQ(localiser_.at(10 * kSightingSecond).state, LocalizationState::Localized) << "confirmed by second 14";
}

TEST_F(LocaliserTest, AMatchBeforeTheLossConfirmsNothingHoweverLateItArrives) {
  drive(6);
  for (const int second : {1, 3}) see(second);
  drive(2, 0.02, urban_nav_core::Health::Lost);
  drive(2, 0.01);
  see(6);
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::OdometryLost);
  see(9);
  expectRight(0.05);
}

TEST_F(LocaliserTest, AnInitialPoseDoesNotConfirmAPrediction) {
  drive(6);
  for (const int second : {1, 3, 5}) see(second);
  drive(2, 0.02, urban_nav_core::Health::Lost);
  drive(2, 0.01);
  localiser_.addInitialPose(9 * kSightingSecond, {truth(9), 0.01 * urban_nav_core::Matrix6d::Identity()});
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::OdometryLost);
}

TEST_F(LocaliserTest, OldMatchesAreDropped) {
  drive(10);
  for (const int second : {1, 3, 5}) see(second);
  drive(30000, 1e-4);
  EXPECT_EQ(localiser_.at(5 * kSightingSecond).reason, LocalizationReason::NoMatch);
  see(30005);
  see(30009);
  expectRight(0.02);
}

TEST_F(LocaliserTest, AnInitialPoseIsNotKnownAndOneMatchIsNotEnough) {
  drive(4);
  localiser_.addInitialPose(1 * kSightingSecond, {truth(1), 0.01 * urban_nav_core::Matrix6d::Identity()});
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
  ASSERT_TRUE(localiser_.now().T_map_base);
  EXPECT_LT(distanceBetween(localiser_.now().T_map_base->pose, truth(4)), 0.01);
  see(3);
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
  see(4);
  expectRight(0.02);
}

TEST_F(LocaliserTest, AnUncertainInitialPoseDoesNotConfirmInconsistentMatches) {
  drive(8);
  see(2, poseAt(1.0, 1.0));
  see(6, poseAt(-1.0, -1.0));
  localiser_.addInitialPose(4 * kSightingSecond, {truth(4), 9.0 * urban_nav_core::Matrix6d::Identity()});
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain) << localiser_.now().sentence;
}

TEST_F(LocaliserTest, AnInitialPoseMovesNoMatchedPose) {
  drive(8);
  for (const int second : {1, 3, 5}) see(second);
  const LocalizationEstimate before = localiser_.now();
  localiser_.addInitialPose(7 * kSightingSecond, {truth(7) * poseAt(0.3), 0.01 * urban_nav_core::Matrix6d::Identity()});
  localiser_.addInitialPose(8 * kSightingSecond, {poseAt(-40.0, 3.0), 1e-4 * urban_nav_core::Matrix6d::Identity()});
  EXPECT_TRUE(isApprox(*localiser_.now().T_map_base, *before.T_map_base, 0.0));
  expectRight(0.01);
}

TEST_F(LocaliserTest, ReasonAndProbabilityFollowTheObservations) {
  drive(10);
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::NoMatch);
  EXPECT_EQ(localiser_.now().probability, 0.0);
  localiser_.addInitialPose(0, {truth(0), 0.01 * urban_nav_core::Matrix6d::Identity()});
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::InitialPoseOnly);
  const double prior = localiser_.now().probability;
  EXPECT_LT(prior, 0.5) << "it is unknown how often people are right";
  see(1);
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::SingleMatch);
  const double one = localiser_.now().probability;
  EXPECT_GT(one, prior);
  see(4, poseAt(20.0));
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::SingleMatch);
  EXPECT_LT(localiser_.now().probability, 0.5) << "one against one";
  see(6);
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::None);
  const double against_one = localiser_.now().probability;
  EXPECT_GT(against_one, 0.9);
  see(8);
  EXPECT_GT(localiser_.now().probability, against_one);
  EXPECT_LE(localiser_.now().probability, 1.0);
  see(9, poseAt(20.0));
  see(10, poseAt(20.0));
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::Contested);
  EXPECT_STREQ(toString(localiser_.now().reason), "Contested");
}

TEST_F(LocaliserTest, AWallAloneIsNoHypothesis) {
  drive(6);
  for (const int second : {1, 3, 5}) {
    const Pose T_map_a = poseAt(11.0 + second, 7.0);
    Constraint measured;
    measured.T_a_b = T_map_a.inverse() * truth(second) * poseAt(4.0);  // slid along it
    measured.information.diagonal() << 0.0, Eigen::Vector2d::Constant(1e4), Eigen::Vector3d::Constant(1e6);
    localiser_.addMatch(second * kSightingSecond, T_map_a, measured);
  }
  EXPECT_EQ(localiser_.now().state, LocalizationState::Uncertain);
  see(4);
  see(6);
  expectRight(0.02);
}

TEST_F(LocaliserTest, WhatIsNotFirmBeginsNothingAndCarriesNothing) {
  const Pose elsewhere = poseAt(20.0, 3.0);
  drive(4);
  const auto seeFromAfar = [&](int second, const Pose& error) {
    Constraint measured;
    measured.T_a_b = error * truth(second);
    measured.information.diagonal() << Eigen::Vector3d::Constant(1e4), Eigen::Vector3d::Constant(1e6);
    localiser_.addMatch(second * kSightingSecond, Pose(), measured, false);
  };
  for (const int second : {1, 2, 3}) seeFromAfar(second, elsewhere);
  EXPECT_FALSE(localiser_.now().T_map_base) << localiser_.now().sentence;
  see(4);
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::SingleMatch);
  drive(4);
  seeFromAfar(6, Pose());
  expectRight(0.02);
  for (const int second : {6, 7, 8}) seeFromAfar(second, elsewhere);
  expectRight(0.02);
}

TEST_F(LocaliserTest, AStretchWithoutMatchesIsMeasured) {
  EXPECT_EQ(localiser_.distanceSinceMatch(), 0.0);
  drive(5);
  EXPECT_NEAR(localiser_.distanceSinceMatch(), 5.0, 1e-9);
  localiser_.addInitialPose(4 * kSightingSecond, {truth(4), urban_nav_core::Matrix6d::Identity()});
  EXPECT_NEAR(localiser_.distanceSinceMatch(), 5.0, 1e-9) << "nothing was seen of it";
  see(3);
  EXPECT_NEAR(localiser_.distanceSinceMatch(), 2.0, 1e-9);
}

TEST_F(LocaliserTest, WhatIsNoNumberOrOfNoMomentIsLeftOut) {
  drive(3);
  Constraint broken;
  broken.information(0, 0) = std::numeric_limits<double>::quiet_NaN();
  localiser_.addMatch(1 * kSightingSecond, Pose(), broken);
  see(100);
  EXPECT_FALSE(localiser_.now().T_map_base);
}

}  // namespace
}  // namespace urban_nav_localization
