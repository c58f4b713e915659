// SPDX-License-Identifier: BSD-3-Clause
#include "motion.hpp"

#include <gtest/gtest.h>

namespace laser_odometry {
namespace {

Pose relativeStep(double speed, double rate, double seconds) {
  Vector6d twist;
  twist << speed, 0, 0, 0, 0, rate;
  return urban_nav_core::expSe3(twist * seconds);
}

TEST(MotionModel, ConstantVelocityIsPredictedExactly) {
  MotionModel motion{Parameters()};
  motion.update(relativeStep(5.0, 0.3, 0.1), 0.1, true);
  motion.update(relativeStep(5.0, 0.3, 0.1), 0.1, true);
  EXPECT_TRUE(isApprox(motion.predict(0.25), relativeStep(5.0, 0.3, 0.25), 1e-12));
}

TEST(MotionModel, ConstantAccelerationGivesTheVelocityInTheMiddleOfTheSweep) {
  MotionModel motion{Parameters()};
  // Steps of 0.1 s at a = 2 m/s^2 from 1 m/s: means 1.1 and 1.3 m/s, velocity at the end of the second 1.4 m/s.
  motion.update(relativeStep(1.1, 0.0, 0.1), 0.1, true);
  EXPECT_NEAR(motion.sweepTwist(relativeStep(1.3, 0.0, 0.1), 0.1)[0], 1.4, 1e-12);
}

TEST(MotionModel, UncertaintyGrowsWhileTheVelocityIsNotObserved) {
  MotionModel motion{Parameters()};
  EXPECT_FALSE(motion.isKnown());
  const double unknown = motion.predictionCovariance(0.1)(0, 0);
  motion.update(relativeStep(5.0, 0.0, 0.1), 0.1, true);
  const double after = motion.predictionCovariance(0.1)(0, 0);
  for (int i = 0; i < 10; ++i) motion.update(relativeStep(5.0, 0.0, 0.1), 0.1, false);
  const double later = motion.predictionCovariance(0.1)(0, 0);
  EXPECT_LT(after, later);
  EXPECT_LT(later, unknown);
}

}  // namespace
}  // namespace laser_odometry
