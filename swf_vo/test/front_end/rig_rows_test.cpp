// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/rig_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace swf_vo {
namespace {

constexpr double kRigFocalPx = 400.0;
const urban_nav_core::StereoCamera kRigCamera = {{kRigFocalPx, kRigFocalPx, 255.5, 191.5, 512, 384}, 0.12};
constexpr RigRows::Priors kRigPriors = {1e-3, 1e-4};

struct RigTruth {
  double offset_px = 0.0, roll = 0.0, delay_s = 0.0;
  double outliers = 0.0;  ///< share of matches
  double place_px = 0.0;  ///< standard deviation of an error that depends on the position in the image
  bool moving = true;
};

RigConstants learnRig(const RigTruth& rig, int frames, std::uint32_t seed = 1) {
  RigRows rows(kRigPriors, kRigCamera);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double places[8][6];
  for (auto& column : places)
    for (double& place : column) place = rig.place_px * normal(random);
  for (int frame = 0; frame < frames; ++frame) {
    const double pitch_rate = rig.moving ? 0.2 * std::sin(0.3 * frame) : 0.0;
    for (int i = 0; i < 10; ++i) {
      RigRows::Difference one;
      one.direction = {0.7 * uniform(random), 0.5 * uniform(random)};
      one.flow_px_s = rig.moving ? kRigFocalPx * (pitch_rate + 0.1 * one.direction.y()) : 0.0;
      one.px =
          rig.offset_px - rig.roll * kRigFocalPx * one.direction.x() + rig.delay_s * one.flow_px_s +
          0.1 * normal(random) +
          places[static_cast<int>(5.0 * (one.direction.x() + 0.8))][static_cast<int>(3.75 * (one.direction.y() + 0.8))];
      if (uniform(random) < 2.0 * rig.outliers - 1.0) one.px = 6.0 * uniform(random);
      rows.see(one);
    }
    rows.learn();
  }
  return rows.evaluate();
}

TEST(RigRows, ReturnsItsPriorsBeforeAnyMeasurement) {
  RigRows rows(kRigPriors, kRigCamera);
  EXPECT_EQ(rows.evaluate().roll_rad, 0.0);
  rows.learn();
  EXPECT_NEAR(rows.evaluate().roll_sigma_rad, kRigPriors.roll, 1e-9);
  EXPECT_NEAR(rows.evaluate().delay_sigma_s, kRigPriors.delay_s, 1e-9);
}

TEST(RigRows, FindsRollAndDelayDespiteAnOffset) {
  const RigConstants found = learnRig({-0.7, 8e-4, -3e-4}, 300);
  EXPECT_NEAR(found.roll_rad, 8e-4, 3e-5);
  EXPECT_NEAR(found.delay_s, -3e-4, 3e-5);
  EXPECT_LT(found.roll_sigma_rad, 3e-5);
  EXPECT_LT(found.delay_sigma_s, 5e-5);
}

TEST(RigRows, FindsWhatIsFarOutsideThePriors) {
  const RigConstants found = learnRig({0.2, 1e-2, 2.8e-3}, 300);
  EXPECT_NEAR(found.roll_rad, 1e-2, 2e-4);
  EXPECT_NEAR(found.delay_s, 2.8e-3, 1e-4);
}

TEST(RigRows, OutliersDoNotCarryItAway) {
  const RigConstants found = learnRig({0.0, 5e-4, 1e-4, 0.1}, 300);
  EXPECT_NEAR(found.roll_rad, 5e-4, 6e-5);
  EXPECT_NEAR(found.delay_s, 1e-4, 6e-5);
}

TEST(RigRows, AtRestTheDelayIsNotObservable) {
  RigTruth rig{0.1, 5e-4, 3e-3};
  rig.moving = false;
  const RigConstants found = learnRig(rig, 300);
  EXPECT_NEAR(found.delay_sigma_s, kRigPriors.delay_s, 1e-3 * kRigPriors.delay_s);
  EXPECT_NEAR(found.delay_s, 0.0, 1e-9);
  EXPECT_NEAR(found.roll_rad, 5e-4, 3e-5);
}

/// Returns the ratio of the mean squared error to the stated variance over many rigs; errors of positions do not
/// average out over landmarks.
double varianceRatio(double place_px) {
  double squares = 0.0, stated = 0.0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(1000 + seed);
    RigTruth rig;
    rig.roll = std::normal_distribution<double>(0.0, kRigPriors.roll)(random);
    rig.place_px = place_px;
    const RigConstants found = learnRig(rig, 60, seed);
    squares += (found.roll_rad - rig.roll) * (found.roll_rad - rig.roll);
    stated += found.roll_sigma_rad * found.roll_sigma_rad;
  }
  return squares / stated;
}

TEST(RigRows, SigmaHoldsForMatchesThatErrAlone) {
  EXPECT_GT(varianceRatio(0.0), 0.4);
  EXPECT_LT(varianceRatio(0.0), 1.5);
}

TEST(RigRows, SigmaHoldsWherePlacesOfTheImageErr) {
  EXPECT_GT(varianceRatio(0.15), 0.4);
  EXPECT_LT(varianceRatio(0.15), 2.0);
}

}  // namespace
}  // namespace swf_vo
