// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/odometry_chain.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace {

using namespace urban_nav_core;

constexpr StampNs kStep = 50'000'000;

Matrix6d someCovariance(urban_nav_core::testing::Dice& dice, double scale) {
  Matrix6d root;
  for (int i = 0; i < 36; ++i) root.data()[i] = scale * dice.normal();
  return root * root.transpose() + 1e-3 * scale * scale * Matrix6d::Identity();
}

std::vector<RelativePose> someSteps(std::size_t count, bool with_drift) {
  urban_nav_core::testing::Dice dice(7);
  std::vector<RelativePose> steps;
  for (std::size_t i = 0; i < count; ++i) {
    RelativePose step;
    step.from = static_cast<StampNs>(i) * kStep;
    step.to = step.from + kStep;
    Vector6d tangent;
    for (int k = 0; k < 6; ++k) tangent[k] = (k < 3 ? 0.3 : 0.1) * dice.normal();
    step.T_from_to = expSe3(tangent);
    step.covariance = someCovariance(dice, 1e-3);
    if (with_drift) step.drift_covariance = 0.1 * step.covariance;
    steps.push_back(step);
  }
  return steps;
}

OdometryChain makeChain(const std::vector<RelativePose>& steps) {
  OdometryChain chain;
  for (const RelativePose& step : steps) EXPECT_TRUE(chain.append(step));
  return chain;
}

/// One step after the other.
PoseWithCovariance composed(const std::vector<RelativePose>& steps, std::size_t from, std::size_t to) {
  PoseWithCovariance way{Pose(), Matrix6d::Zero()};
  for (std::size_t i = from; i < to; ++i) {
    Matrix6d covariance = steps[i].drift_covariance.isZero(0.0) ? steps[i].covariance : steps[i].drift_covariance;
    if (!steps[i].drift_covariance.isZero(0.0))
      covariance += (i == from ? 0.5 : 0.0) * steps[i].covariance + (i + 1 == to ? 0.5 : 0.0) * steps[i].covariance;
    way = compose(way, PoseWithCovariance{steps[i].T_from_to, covariance});
  }
  return way;
}

void expectSame(const PoseWithCovariance& a, const PoseWithCovariance& b) {
  EXPECT_LT(distanceBetween(a.pose, b.pose), 1e-9);
  EXPECT_LT(angleBetween(a.pose, b.pose), 1e-9);
  EXPECT_LT((a.covariance - b.covariance).norm(), 1e-7 * b.covariance.norm());
}

TEST(OdometryChain, AMotionIsTheProductOfItsStepsAcrossBlocks) {
  for (const bool with_drift : {false, true}) {
    const std::vector<RelativePose> steps = someSteps(700, with_drift);
    const OdometryChain chain = makeChain(steps);
    for (const auto& [from, to] : std::vector<std::pair<std::size_t, std::size_t>>{
             {0, 1}, {3, 4}, {10, 200}, {255, 257}, {256, 512}, {100, 699}, {0, 700}, {690, 700}}) {
      const auto way = chain.between(static_cast<StampNs>(from) * kStep, static_cast<StampNs>(to) * kStep);
      ASSERT_TRUE(way);
      expectSame(*way, composed(steps, from, to));
    }
  }
}

TEST(OdometryChain, TheMotionBackIsTheInverse) {
  const OdometryChain chain = makeChain(someSteps(40, true));
  expectSame(*chain.between(30 * kStep, 5 * kStep), invert(*chain.between(5 * kStep, 30 * kStep)));
}

TEST(OdometryChain, NothingIsUncertainBetweenMomentsOfOneFrame) {
  const OdometryChain chain = makeChain(someSteps(10, true));
  const auto way = chain.between(4 * kStep + 1'000'000, 4 * kStep - 1'000'000);
  ASSERT_TRUE(way);
  EXPECT_TRUE(way->covariance.isZero(0.0));
  EXPECT_GT(way->pose.t().norm(), 0.0);
}

TEST(OdometryChain, MomentsBetweenFramesAreOnThePath) {
  const OdometryChain chain = makeChain(someSteps(10, true));
  const StampNs stamp = 3 * kStep + kStep / 4;
  const auto way = chain.between(0, stamp);
  ASSERT_TRUE(way);
  EXPECT_LT(distanceBetween(way->pose, *chain.trajectory().at(stamp, kStep)), 1e-9);
  EXPECT_LT(distanceBetween(way->pose, *chain.at(stamp)), 1e-9);
}

TEST(OdometryChain, JustOutsideTheMotionGoesOnAndFurtherOutNothingIsKnown) {
  const OdometryChain chain = makeChain(someSteps(10, true));
  EXPECT_TRUE(chain.at(-90'000'000));
  EXPECT_TRUE(chain.at(10 * kStep + 90'000'000));
  EXPECT_FALSE(chain.at(-110'000'000));
  EXPECT_FALSE(chain.at(10 * kStep + 110'000'000));
  EXPECT_FALSE(chain.between(0, 11 * kStep + 200'000'000));
  EXPECT_FALSE(OdometryChain().at(0));
  EXPECT_EQ(OdometryChain().distance(0), 0.0);
}

TEST(OdometryChain, FramesFarApartHaveNothingBetweenThem) {
  OdometryChain chain;
  RelativePose step;
  step.to = 3'000'000'000;
  ASSERT_TRUE(chain.append(step));
  EXPECT_FALSE(chain.at(1'500'000'000));
  EXPECT_FALSE(chain.at(50'000'000));  // beside a frame, but inside the gap
  EXPECT_TRUE(chain.at(3'000'000'000));
}

TEST(OdometryChain, DistanceGrowsAlongThePath) {
  const std::vector<RelativePose> steps = someSteps(5, true);
  const OdometryChain chain = makeChain(steps);
  EXPECT_NEAR(chain.distance(2 * kStep), steps[0].T_from_to.t().norm() + steps[1].T_from_to.t().norm(), 1e-12);
  EXPECT_GT(chain.distance(2 * kStep + kStep / 4), chain.distance(2 * kStep));
  EXPECT_LT(chain.distance(2 * kStep - kStep / 4), chain.distance(2 * kStep));
}

TEST(OdometryChain, StepsThatDoNotFitAreLeftOut) {
  OdometryChain chain = makeChain(someSteps(3, true));
  RelativePose step;
  step.from = kStep;
  step.to = 9 * kStep;
  EXPECT_FALSE(chain.append(step));
  step.from = 3 * kStep;
  step.to = 3 * kStep;
  EXPECT_FALSE(chain.append(step));
  step.to = 4 * kStep;
  step.covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(chain.append(step));
  EXPECT_EQ(chain.trajectory().size(), 4U);
}

}  // namespace
