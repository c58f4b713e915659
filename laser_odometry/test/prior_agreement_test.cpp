// SPDX-License-Identifier: BSD-3-Clause
#include "prior_agreement.hpp"

#include <gtest/gtest.h>

#include "support/free_places.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace laser_odometry {
namespace {

constexpr double kWheelNoise = 0.02;  // of the distance of a step

/// A prior from the true motion: distances times a scale, turns times a factor, and noise with the stated covariance.
MakePrior makePrior(const FreePlace& place, std::uint64_t seed, double scale, double turn_factor) {
  const auto motion = makeMotion(place, seed);
  return [=](double from, double to) {
    urban_nav_core::testing::Dice dice(static_cast<std::uint64_t>(std::llround(1e3 * to)) + 77 * seed);
    const Pose truth = motion(from).inverse() * motion(to);
    const double sigma = kWheelNoise * truth.t().norm() + 1e-4, turn_sigma = 1e-3;
    const Vector3d noise(sigma * dice.normal(), 1e-3 * dice.normal(), 1e-3 * dice.normal());
    MotionPrior prior;
    prior.step.T_from_to = Pose(urban_nav_core::expSo3(turn_factor * urban_nav_core::logSo3(truth.q()) +
                                                       Vector3d(0.0, 0.0, turn_sigma * dice.normal())),
                                scale * truth.t() + noise);
    Vector6d variances;
    variances << sigma * sigma, 1e-6, 1e-6, 1e-6, 1e-6, turn_sigma * turn_sigma;
    prior.step.covariance = variances.asDiagonal();
    return std::optional<MotionPrior>(prior);
  };
}

int countSentences(const FreeRun& run, const std::string& words) {
  int count = 0;
  for (const LaserPose& pose : run.poses) count += pose.status.sentence.find(words) != std::string::npos ? 1 : 0;
  return count;
}

const FreePlace& corridor() {
  static const FreePlace place = makeFreePlaces()[1];
  return place;
}

TEST(MotionPriors, TheErrorAlongACorridorIsThatOfTheWheels) {
  for (const std::uint64_t seed : {1, 2}) {
    const FreeRun without = driveFreePlace(corridor(), {}, seed);
    const FreeRun with = driveFreePlace(corridor(), {}, seed, makePrior(corridor(), seed, 1.0, 1.0));
    const std::size_t last = with.poses.size() - 1;
    EXPECT_EQ(countSentences(with, "left out"), 0);
    EXPECT_GT(with.free(), 100);
    EXPECT_LT(with.error(last), 0.1);  // 200 free steps of 0.1 m with 2 % and 0.1 mm: 29 mm
    EXPECT_LT(20.0 * with.error(last), without.error(last));
    EXPECT_LT(with.error(last), 4.0 * with.stated());
    for (const std::size_t sweeps : {1, 10, 50}) {
      EXPECT_GT(with.nees(sweeps), 1.0) << sweeps;
      EXPECT_LT(with.nees(sweeps), 6.0) << sweeps;
    }
  }
}

TEST(MotionPriors, WheelsOfAnotherScaleAreLeftOutAndNamed) {
  const FreeRun run = driveFreePlace(corridor(), {}, 1, makePrior(corridor(), 1, 1.3, 1.0));
  const FreeRun without = driveFreePlace(corridor(), {}, 1);
  EXPECT_GT(countSentences(run, "the prior of the motion is left out: it contradicts the sweeps, it moves"), 200);
  const std::size_t last = run.poses.size() - 1;
  EXPECT_LT(run.error(last), 1.5 * without.error(last) + 0.5);
  EXPECT_LT(run.error(last), 3.0 * run.stated());
}

TEST(MotionPriors, AGyroscopeInDegreesIsLeftOutAndNamed) {
  const FreeRun run = driveFreePlace(corridor(), {}, 1, makePrior(corridor(), 1, 1.0, 180.0 / M_PI));
  EXPECT_GT(countSentences(run, "it turns"), 200);
  const Pose last = run.truth.front().inverse() * run.truth.back();
  EXPECT_LT(urban_nav_core::angleBetween(last, run.poses.back().T_odom_base), 0.02);
}

TEST(MotionPriors, FrozenWheelsAreLeftOutAndNamed) {
  const FreeRun run = driveFreePlace(corridor(), {}, 2, makePrior(corridor(), 2, 0.0, 1.0));
  EXPECT_GT(countSentences(run, "it moves 0.0"), 200);
  EXPECT_LT(run.error(run.poses.size() - 1), 3.0 * run.stated());
}

ComparedStep compared(double by_sweeps, double by_prior) {
  ComparedStep step;
  step.seconds = 0.1;
  step.by_sweeps = Pose(Eigen::Quaterniond::Identity(), {by_sweeps, 0.0, 0.0});
  step.by_prior = Pose(Eigen::Quaterniond::Identity(), {by_prior, 0.0, 0.0});
  step.covariance_by_sweeps = 1e-6 * Matrix6d::Identity();
  return step;
}

TEST(PriorAgreement, AtRestNothingContradicts) {
  PriorAgreement agreement;
  for (int i = 0; i < 200; ++i) agreement.add(compared(0.0, 1e-4), {});
  EXPECT_FALSE(agreement.isLeftOut());
}

TEST(PriorAgreement, FreeDirectionsAreNotCompared) {
  PriorAgreement agreement;
  for (int i = 0; i < 200; ++i) agreement.add(compared(0.1, 0.3), {Vector6d::Unit(0)});
  EXPECT_FALSE(agreement.isLeftOut());
  EXPECT_FALSE(agreement.isFarFrom(compared(0.1, 0.3), {}));  // its beginning is free
  for (int i = 0; i < 30; ++i) agreement.add(compared(0.1, 0.3), {});
  EXPECT_TRUE(agreement.isLeftOut());
  EXPECT_TRUE(agreement.isFarFrom(compared(0.1, 0.3), {}));
}

TEST(PriorAgreement, APriorThatAgreesAgainIsUsedAgainAndTrustedLessEachTime) {
  PriorAgreement agreement;
  double first = 0.0;
  for (const int round : {0, 1}) {
    for (int i = 0; i < 100 && !agreement.isLeftOut(); ++i) agreement.add(compared(0.1, 0.2), {});
    ASSERT_TRUE(agreement.isLeftOut());
    int steps = 0;
    for (; steps < 1000 && agreement.isLeftOut(); ++steps) agreement.add(compared(0.1, 0.1), {});
    EXPECT_FALSE(agreement.isLeftOut());
    EXPECT_GT(0.1 * steps, 4.5);
    if (round == 0) first = steps;
    else EXPECT_GT(steps, 1.5 * first);
  }
}

}  // namespace
}  // namespace laser_odometry
