// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(Motion, OpticalAxesPointAlongTheHeading) {
  const Matrix3d R = lookingAlong({1, 2, 3}, 0.0).R();
  EXPECT_TRUE(R.col(2).isApprox(Vector3d::UnitX(), 1e-12));
  EXPECT_TRUE(R.col(0).isApprox(-Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(R.col(1).isApprox(-Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE(lookingAlong({0, 0, 0}, kPi / 2).R().col(2).isApprox(Vector3d::UnitY(), 1e-12));
  EXPECT_LT(lookingAlong({0, 0, 0}, 0.0, 0.1).R().col(2).z(), 0.0) << "pitched down";
  EXPECT_GT(lookingAlong({0, 0, 0}, 0.0, 0.0, 0.1).R().col(0).z() * -1.0, 0.0) << "rolled to the right";
}

TEST(Motion, EveryNamedMotionIsSmooth) {
  for (const char* scene : {"room", "street"}) {
    for (const std::string& name : motionNames()) {
      const Motion motion = namedMotion(name, scene, 3);
      const double h = 0.01;
      for (double t = h; t < 26.0; t += h) {
        const Pose before = motion(t - h), here = motion(t), after = motion(t + h);
        ASSERT_TRUE(here.isFinite());
        const Vector6d a = boxMinus(here, before), b = boxMinus(after, here);
        // A discontinuity appears as a change of speed between consecutive hundredths of a second: 10 m/s^2 and rad/s^2
        // are the limit.
        ASSERT_LT((b - a).norm(), 10.0 * h * h) << scene << " " << name << " at " << t;
      }
    }
  }
}

TEST(Motion, CreepsAtTwoCentimetresPerSecond) {
  const Motion motion = namedMotion("creep", "room", 1);
  EXPECT_EQ(distanceBetween(motion(0.0), motion(1.0)), 0.0);
  EXPECT_NEAR(distanceBetween(motion(0.0), motion(3.6)), 0.05, 1e-9);
  EXPECT_NEAR(distanceBetween(motion(4.0), motion(5.0)), 0.02, 1e-9);
}

TEST(Motion, SpinsAtSixtyDegreesPerSecond) {
  const Motion motion = namedMotion("spin", "room", 1);
  EXPECT_NEAR(angleBetween(motion(2.0), motion(2.1)), kPi / 30.0, 1e-9);
}

TEST(Motion, TurnsStopAndComeAround) {
  const Motion motion = namedMotion("turns", "room", 1);
  EXPECT_NEAR(angleBetween(motion(1.5), motion(2.2)), 0.0, 1e-9) << "a stop";
  EXPECT_GT(angleBetween(motion(2.4), motion(3.2)), 0.2) << "a turn";
  EXPECT_TRUE(isApprox(motion(0.0), motion(18.0), 1e-9)) << "eight parts of 2.25 s";
  EXPECT_NEAR(angleBetween(motion(0.0), motion(9.0)), kPi, 1e-6);
}

TEST(Motion, TheLoopClosesAndStaysInside) {
  const Motion motion = namedMotion("loop", "room", 1);
  EXPECT_LT(distanceBetween(motion(0.0), motion(24.0)), 0.03);
  const Scene room = texturedRoom();
  for (const char* name : {"loop", "wander", "turns", "spin"}) {
    const Motion m = namedMotion(name, "room", 5);
    for (double t = 0.0; t < 30.0; t += 0.4) {
      const Pose T = m(t);
      for (double angle = 0.0; angle < 6.2; angle += 0.3) {
        const auto hit = room.trace(T.t(), Vector3d(std::cos(angle), std::sin(angle), 0.0));
        ASSERT_TRUE(hit) << name << " at " << t << ": outside the room or inside a box";
        EXPECT_GT(hit->distance, 0.15) << name << " at " << t;
      }
    }
  }
}

TEST(Motion, StraightFollowsTheOpticalAxisAndWanderItsSeed) {
  const Motion motion = straight(lookingAlong({0, 0, 1}, 0.3), 0.5);
  EXPECT_TRUE(motion(4.0).t().isApprox(Vector3d(2.0 * std::cos(0.3), 2.0 * std::sin(0.3), 1.0), 1e-12));
  EXPECT_TRUE(isApprox(namedMotion("wander", "room", 7)(3.0), namedMotion("wander", "room", 7)(3.0), 0.0));
  EXPECT_GT(distanceBetween(namedMotion("wander", "room", 7)(3.0), namedMotion("wander", "room", 8)(3.0)), 0.01);
}

TEST(Motion, AnUnknownNameIsAnsweredWithTheKnownOnes) {
  try {
    namedMotion("fly", "room", 1);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("stand, straight, creep"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace urban_nav_core::testing
