// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/wheels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/simulate_drive.hpp"
#include "proprioception/test_motion.hpp"

namespace urban_nav_sim {
namespace {

using urban_nav_core::Pose;

const Clock kWheelClock(0, ClockOptions{}, Noise(1, "clock"));
const Schedule kWheelSchedule = sensorSchedule(Sensor::Wheels);

TEST(Wheels, WithoutErrorsDeadReckoningFollowsTheTruePath) {
  const auto motion = testMotion(120.0, false, 0.0);
  const Wheels wheels(*motion, perfectWheels(), kWheelClock, Noise(7, "wheels"));
  const Pose T_base_world = motion->at(0.0).T_world_base.inverse();
  double furthest = 0.0, turned = 0.0;
  for (std::int64_t k = 0; k < wheels.count(); ++k) {
    const Pose truth = T_base_world * motion->at(kWheelSchedule.at(k)).T_world_base;
    // base_link swings below the axle as the body leans: 0.24 m times the lean.
    furthest = std::max(furthest, (truth.t() - wheels.at(k).T_odom_base.t()).head<2>().norm());
    turned = std::max(turned, urban_nav_core::angleBetween(truth, wheels.at(k).T_odom_base));
  }
  EXPECT_LT(furthest, 0.06);
  EXPECT_LT(turned, 0.12);  // the lean itself
}

TEST(Wheels, SpeedsAreThoseOfTheAxle) {
  const auto motion = testMotion(60.0, true);
  const Wheels wheels(*motion, perfectWheels(), kWheelClock, Noise(7, "wheels"));
  for (std::int64_t k = 0; k < wheels.count(); k += 20) {
    const MotionState motion_state = motion->at(kWheelSchedule.at(k));
    EXPECT_NEAR(wheels.at(k).speed, motion_state.velocity_world.dot(motion_state.T_world_base.R().col(0)), 0.08);
    EXPECT_NEAR(wheels.at(k).yaw_rate, motion_state.rate_base.z(), 0.05);
  }
}

TEST(Wheels, ErrorsGrowWithTheDistance) {
  const auto motion = testMotion(200.0);
  const Wheels perfect(*motion, perfectWheels(), kWheelClock, Noise(7, "wheels"));
  double after_10_m = 0.0, at_end = 0.0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Wheels wheels(*motion, WheelOptions{}, kWheelClock, Noise(seed, "wheels"));
    ASSERT_EQ(wheels.count(), perfect.count());
    const auto off = [&](std::int64_t k) {
      return (wheels.at(k).T_odom_base.t() - perfect.at(k).T_odom_base.t()).norm();
    };
    after_10_m += off(300) / 5.0;
    at_end += off(wheels.count() - 1) / 5.0;
  }
  EXPECT_GT(after_10_m, 0.005);
  EXPECT_LT(after_10_m, 0.5);
  EXPECT_GT(at_end, 0.2);
  EXPECT_LT(at_end, 15.0);
}

TEST(Wheels, ComeInStepsOfTheCounters) {
  const auto motion = testMotion(20.0);
  const Wheels wheels(*motion, WheelOptions{}, kWheelClock, Noise(7, "wheels"));
  for (std::int64_t k = 0; k < wheels.count(); k += 7) {
    const double counts = wheels.at(k).speed * 332.0;
    EXPECT_NEAR(counts, std::round(counts), 1e-9);
  }
}

TEST(Wheels, AreAsManyAsTheScheduleHas) {
  const auto motion = testMotion(36.0);
  const Wheels wheels(*motion, WheelOptions{}, kWheelClock, Noise(7, "wheels"));
  EXPECT_EQ(wheels.count(), 1000);
  EXPECT_EQ(wheels.at(1).stamp - wheels.at(0).stamp, 36000000);
}

TEST(Wheels, StatedErrorsExplainTheSpeeds) {
  const auto motion = testMotion(30.0);
  const Wheels perfect(*motion, perfectWheels(), kWheelClock, Noise(7, "wheels"));
  WheelOptions options;
  options.track = 1.0;
  options.counts = false;
  options.largest_scale = 0.03;
  const Wheels wheels(*motion, options, kWheelClock, Noise(7, "wheels"));
  EXPECT_GT(std::abs(wheels.errorsAt(0).left_scale - 1.0), 1e-3);
  EXPECT_LT(std::abs(wheels.errorsAt(0).left_scale - 1.0), 0.05);
  for (std::int64_t k = 0; k < wheels.count(); k += 11) {
    const Wheels::Errors& errors = wheels.errorsAt(k);
    const WheelMeasurement &truth = perfect.at(k), &measured = wheels.at(k);
    const double left = measured.speed - 0.5 * kTrack * measured.yaw_rate;
    const double true_left = truth.speed - 0.5 * kTrack * truth.yaw_rate;
    EXPECT_NEAR(left, true_left * errors.left_scale * (1.0 + errors.slip_left), 1e-9);
    const double right = measured.speed + 0.5 * kTrack * measured.yaw_rate;
    const double true_right = truth.speed + 0.5 * kTrack * truth.yaw_rate;
    EXPECT_NEAR(right, true_right * errors.right_scale * (1.0 + errors.slip_right), 1e-9);
  }
}

}  // namespace
}  // namespace urban_nav_sim
