// SPDX-License-Identifier: BSD-3-Clause
#include "prediction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace swf_vo {
namespace {

using urban_nav_core::expSe3;
using urban_nav_core::logSe3;
using urban_nav_core::Matrix6d;
using urban_nav_core::MotionInput;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;

constexpr std::int64_t kMs = 1000000;

Vector6d twist(double vx, double vy, double vz, double wx, double wy, double wz) {
  Vector6d v;
  v << vx, vy, vz, wx, wy, wz;
  return v;
}

TEST(Prediction, GoesOnAtTheVelocityOfTheLastStep) {
  Prediction prediction{Parameters(), Pose()};
  const Vector6d velocity = twist(0.3, 0.0, 5.0, 0.0, 0.4, 0.1);
  prediction.learn(expSe3(velocity * 0.1), 0.1, true);
  EXPECT_TRUE(isApprox(prediction.step(0.1, {}).T_from_to, expSe3(velocity * 0.1), 1e-12));
  EXPECT_TRUE(isApprox(prediction.step(0.3, {}).T_from_to, expSe3(velocity * 0.3), 1e-12)) << "two frames were dropped";
}

TEST(Prediction, PredictsNoMotionOverALongPause) {
  Prediction prediction{Parameters(), Pose()};
  prediction.learn(expSe3(twist(0.0, 0.0, 5.0, 0.0, 0.0, 0.0) * 0.1), 0.1, true);
  const ProcessInput u = prediction.step(600.0, {});
  EXPECT_TRUE(isApprox(u.T_from_to, Pose(), 1e-12));
  EXPECT_LT(u.information(2, 2), 1.0 / (1000.0 * 1000.0)) << "anything may have happened";
}

TEST(Prediction, ItsCovarianceGrowsWithTheTimeWithoutMeasurement) {
  Prediction prediction{Parameters(), Pose()};
  prediction.learn(Pose(), 0.1, true);
  double last = prediction.step(0.1, {}).information(0, 0);
  for (int i = 0; i < 5; ++i) {
    prediction.learn(Pose(), 0.1, false, true);
    const double now = prediction.step(0.1, {}).information(0, 0);
    EXPECT_LT(now, last);
    last = now;
  }
  prediction.learn(Pose(), 0.1, true);
  EXPECT_GT(prediction.step(0.1, {}).information(0, 0), last);
}

TEST(Prediction, GivesUpAVelocityThatFindsNothingInGoodImagesButNotInTheDark) {
  const Pose step = expSe3(twist(0.0, 0.0, 2.0, 0.0, 0.0, 0.0));
  Prediction seeing{Parameters(), Pose()}, blind{Parameters(), Pose()};
  seeing.learn(step, 0.1, true);
  blind.learn(step, 0.1, true);
  for (int i = 0; i < 10; ++i) {
    seeing.learn(step, 0.1, false, false);
    blind.learn(step, 0.1, false, true);
  }
  EXPECT_TRUE(isApprox(seeing.step(0.1, {}).T_from_to, Pose(), 1e-12));
  EXPECT_TRUE(isApprox(blind.step(0.1, {}).T_from_to, step, 1e-12));
}

TEST(Prediction, AVelocityThatTurnsBackAllTheTimeFadesInTheDark) {
  const auto stepInTheDark = [](const std::function<double(int)>& speed) {
    Prediction prediction{Parameters(), Pose()};
    const auto at = [&](int i) { return twist(speed(i), 0.0, 0.0, 0.0, speed(i), 0.0); };
    for (int i = 0; i < 20; ++i) prediction.learn(expSe3(at(i) * 0.2), 0.2, true);
    const Pose next = prediction.step(0.2, {}).T_from_to;
    EXPECT_TRUE(isApprox(next, expSe3(at(19) * 0.2), 1e-9)) << "the very next step is as the last";
    for (int i = 0; i < 3; ++i) prediction.learn(next, 0.2, false, true);
    return logSe3(prediction.step(0.2, {}).T_from_to);
  };
  const Vector6d steady = stepInTheDark([](int) { return 0.5; });
  EXPECT_NEAR(steady[0], 0.1, 1e-9);
  EXPECT_NEAR(steady[4], 0.1, 1e-9);
  const Vector6d shaken = stepInTheDark([](int i) { return 0.5 * std::cos(2.5 * i); });
  EXPECT_LT(shaken.norm(), 0.01);
}

TEST(Prediction, TakesAGoodInputInsteadOfTheVelocity) {
  const Pose T_base_camera(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), Vector3d(0.1, 0.0, 1.1));
  Prediction prediction(Parameters(), T_base_camera);
  prediction.learn(Pose(), 0.1, true);
  const Pose motion = expSe3(twist(0.1, 0.0, 0.0, 0.0, 0.0, 0.05));
  const MotionInput input{0, 100 * kMs, motion, 1e12 * Matrix6d::Identity()};
  EXPECT_TRUE(
      isApprox(prediction.step(0.1, {input}).T_from_to, T_base_camera.inverse() * motion * T_base_camera, 1e-6));
}

TEST(Prediction, AGyroscopeTurnsAndLeavesTheTranslationToTheVelocity) {
  Prediction prediction{Parameters(), Pose()};
  prediction.learn(expSe3(twist(0.0, 0.0, 0.1, 0.0, 0.0, 0.0)), 0.1, true);
  Matrix6d information = Matrix6d::Zero();
  information.bottomRightCorner<3, 3>() = 1e12 * Eigen::Matrix3d::Identity();
  std::vector<MotionInput> inputs;
  for (int i = 0; i < 10; ++i)
    inputs.push_back({i * 10 * kMs, (i + 1) * 10 * kMs, expSe3(twist(0, 0, 0, 0, 0.01, 0)), information});
  const ProcessInput u = prediction.step(0.1, inputs);
  EXPECT_NEAR(logSe3(u.T_from_to)(4), 0.1, 1e-6);
  EXPECT_NEAR(u.T_from_to.t().z(), 0.1, 1e-3);
  EXPECT_TRUE(u.information.allFinite());
}

TEST(Prediction, IgnoresInputsThatMakeNoSense) {
  Prediction prediction{Parameters(), Pose()};
  prediction.learn(Pose(), 0.1, true);
  Matrix6d broken = Matrix6d::Identity();
  broken(2, 2) = std::nan("");
  const ProcessInput u = prediction.step(0.1, {{100, 100, Pose(), Matrix6d::Identity()}, {0, 100, Pose(), broken}});
  EXPECT_TRUE(isApprox(u.T_from_to, Pose(), 1e-12));
  EXPECT_TRUE(u.information.allFinite());
}

}  // namespace
}  // namespace swf_vo
