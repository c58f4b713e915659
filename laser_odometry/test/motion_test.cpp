// SPDX-License-Identifier: BSD-3-Clause
#include "motion.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/dice.hpp"

namespace laser_odometry {
namespace {

Pose relativeStep(double speed, double rate, double seconds) {
  Vector6d twist;
  twist << speed, 0, 0, 0, 0, rate;
  return urban_nav_core::expSe3(twist * seconds);
}

/// Updates with a step of 0.1 s at a speed, exactly measured but for the free directions.
void drive(MotionModel& motion, double speed, const std::vector<Vector6d>& free = {}) {
  motion.update(relativeStep(speed, 0.0, 0.1), 0.1, {Matrix6d::Zero(), free});
}

const std::vector<Vector6d> kAlongX = {Vector6d::Unit(0)};

TEST(MotionModel, ConstantVelocityIsPredictedExactly) {
  MotionModel motion{Parameters()};
  motion.update(relativeStep(5.0, 0.3, 0.1), 0.1, {});
  motion.update(relativeStep(5.0, 0.3, 0.1), 0.1, {});
  EXPECT_TRUE(isApprox(motion.predict(0.25), relativeStep(5.0, 0.3, 0.25), 1e-12));
}

TEST(MotionModel, ConstantAccelerationGivesTheVelocityInTheMiddleOfTheSweep) {
  MotionModel motion{Parameters()};
  // Steps of 0.1 s at a = 2 m/s^2 from 1 m/s: means 1.1 and 1.3 m/s, velocity at the end of the second 1.4 m/s.
  drive(motion, 1.1);
  EXPECT_NEAR(motion.sweepTwist(relativeStep(1.3, 0.0, 0.1), 0.1)[0], 1.4, 1e-12);
}

TEST(MotionModel, UncertaintyGrowsWhileTheVelocityIsNotObserved) {
  MotionModel motion{Parameters()};
  EXPECT_FALSE(motion.isKnown());
  const double unknown = motion.predictionCovariance(0.1)(0, 0);
  drive(motion, 5.0);
  const double after = motion.predictionCovariance(0.1)(0, 0);
  for (int i = 0; i < 10; ++i) drive(motion, 5.0, kAlongX);
  const double later = motion.predictionCovariance(0.1)(0, 0);
  EXPECT_LT(after, later);
  EXPECT_LT(later, unknown);
}

TEST(MotionModel, TheVarianceOfAGapDoesNotDependOnTheNumberOfItsSteps) {
  double whole = 0.0;
  for (const int steps : {1, 7, 40}) {
    MotionModel motion{Parameters()};
    drive(motion, 5.0);
    motion.update(relativeStep(5.0, 0.0, 0.1), 0.1, {1e-6 * Matrix6d::Identity(), {}});
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double seconds = 4.0 / steps;
      sum += motion.predictionCovariance(seconds)(0, 0);
      motion.update(motion.predict(seconds), seconds, {Matrix6d::Zero(), kAlongX});
    }
    if (steps == 1) whole = sum;
    EXPECT_NEAR(sum / whole, 1.0, 1e-9) << steps;
  }
}

TEST(MotionModel, TheVarianceOfAGapIsThatOfADriveWithCorrelatedAccelerations) {
  // Accelerations of 1 m/s^2 (parameter) with a correlation time of 2 s, integrated twice in small steps.
  constexpr double kSeconds = 0.01;
  for (const double length : {0.5, 3.0, 10.0}) {
    urban_nav_core::testing::Dice dice(3);
    double squares = 0.0;
    constexpr int kDrives = 2000;
    for (int k = 0; k < kDrives; ++k) {
      double acceleration = dice.normal(), speed = 0.0, position = 0.0;
      const double kept = std::exp(-kSeconds / 2.0), renewed = std::sqrt(1.0 - kept * kept);
      for (double t = 0.0; t < length; t += kSeconds) {
        position += (speed + 0.5 * acceleration * kSeconds) * kSeconds;
        speed += acceleration * kSeconds;
        acceleration = kept * acceleration + renewed * dice.normal();
      }
      squares += position * position / kDrives;
    }
    MotionModel motion{Parameters()};
    drive(motion, 5.0);
    const double of_velocity = 0.1 * length;  // m: the velocity may have changed by 1 m/s^2 within the step of 0.1 s
    const double by_model = motion.predictionCovariance(length)(0, 0) - of_velocity * of_velocity;
    EXPECT_NEAR(std::sqrt(by_model / squares), 1.0, 0.06) << length;
  }
}

TEST(MotionModel, AnUncertainVelocityIsUncertainForTheWholeGap) {
  MotionModel motion{Parameters()};
  // The velocity at the end of a step of 0.1 s with 10 mm: 1.5 of its mean, less 0.5 of the one before.
  Matrix6d covariance = Matrix6d::Zero();
  covariance(0, 0) = 1e-4;
  motion.update(relativeStep(5.0, 0.0, 0.1), 0.1, {covariance, {}});
  const double sigma = std::sqrt(1.5 * 1.5 + 0.5 * 0.5) * 0.1;
  MotionModel exact{Parameters()};
  drive(exact, 5.0);
  const double added = motion.predictionCovariance(3.0)(0, 0) - exact.predictionCovariance(3.0)(0, 0);
  EXPECT_NEAR(std::sqrt(added), 3.0 * sigma, 1e-9);
}

TEST(MotionModel, AStepThatEndsAGapDoesNotMeasureTheVelocity) {
  MotionModel motion{Parameters()};
  drive(motion, 5.0);
  drive(motion, 5.0, kAlongX);
  drive(motion, 9.0);  // the pose is measured again: 0.4 m are the error of the gap
  EXPECT_NEAR(motion.twist()[0], 5.0, 1e-12);
  EXPECT_GT(motion.unobservedSeconds(), 0.15);
  drive(motion, 6.0);
  EXPECT_NEAR(motion.predict(0.1).t().x(), 0.6, 1e-12);  // without the change from 5 m/s, which were not measured
  EXPECT_EQ(motion.unobservedSeconds(), 0.0);
}

TEST(MotionModel, FreeDirectionsThatDependOnEachOtherAreOneDirection) {
  MotionModel motion{Parameters()};
  drive(motion, 5.0);
  Vector6d nearly = Vector6d::Unit(0);
  nearly[1] = 1e-6;
  drive(motion, 7.0, kAlongX);
  motion.update(relativeStep(7.0, 0.2, 0.1), 0.1, {Matrix6d::Zero(), {nearly}});
  EXPECT_NEAR(motion.twist()[0], 5.0, 1e-4);
  EXPECT_NEAR(motion.twist()[5], 0.3, 1e-4);  // measured: the mean of the step and half of its change
}

}  // namespace
}  // namespace laser_odometry
