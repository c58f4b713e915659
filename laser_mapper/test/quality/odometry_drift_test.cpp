// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/odometry_drift.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace laser_mapper {
namespace {

using urban_nav_core::Matrix6d;
using urban_nav_core::RelativePose;
using urban_nav_core::StampNs;

constexpr StampNs kDriftTick = 500'000'000;

/// Returns the step that ends at `tick`, with the covariance `variance` times the identity.
RelativePose stepTo(int tick, double variance, double drift = 0.0) {
  RelativePose step;
  step.from = (tick - 1) * kDriftTick;
  step.to = tick * kDriftTick;
  step.covariance = variance * Matrix6d::Identity();
  step.drift_covariance = drift * Matrix6d::Identity();
  return step;
}

TEST(OdometryDrift, IsTheMeanOverTheStepsOfAStretch) {
  OdometryDrift drift;
  for (int tick = 1; tick <= 8; ++tick) drift.add(stepTo(tick, tick));
  EXPECT_NEAR(drift.rateDuring(0, 8 * kDriftTick)(0, 0), 2.0 * 4.5, 1e-12);
  EXPECT_NEAR(drift.rateDuring(2 * kDriftTick, 4 * kDriftTick)(5, 5), 2.0 * 3.5, 1e-12);
  EXPECT_NEAR(drift.rateDuring(2 * kDriftTick + 1, 2 * kDriftTick + 2)(0, 0), 2.0 * 3.0, 1e-12);
  EXPECT_NEAR(drift.rateDuring(-kDriftTick, kDriftTick)(0, 0), 2.0, 1e-12);
  EXPECT_EQ(drift.rateDuring(9 * kDriftTick, 12 * kDriftTick), Matrix6d::Zero());
  EXPECT_EQ(OdometryDrift().rateDuring(0, kDriftTick), Matrix6d::Zero());
}

TEST(OdometryDrift, OnlyWhatAddsUpCounts) {
  OdometryDrift drift;
  drift.add(stepTo(1, 5.0, 0.25), 3.0);
  EXPECT_NEAR(drift.rateDuring(0, kDriftTick)(0, 0), 2.0 * 3.0 * 0.25, 1e-12);
}

TEST(OdometryDrift, StepsThatCannotBeUsedAreLeftOut) {
  OdometryDrift drift;
  drift.add(stepTo(1, 1.0));
  drift.add(stepTo(1, 100.0));
  drift.add(stepTo(2, std::numeric_limits<double>::infinity()));
  RelativePose backwards = stepTo(3, 100.0);
  std::swap(backwards.from, backwards.to);
  drift.add(backwards);
  EXPECT_NEAR(drift.rateDuring(0, 4 * kDriftTick)(0, 0), 2.0, 1e-12);
}

}  // namespace
}  // namespace laser_mapper
