// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/imu.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "proprioception/test_motion.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using urban_nav_core::Pose;

const Pose kImuPlace(urban_nav_core::expSo3({0.3, -0.2, 1.1}), {0.12, -0.07, 0.5});
const Clock kImuClock(0, ClockOptions{}, Noise(1, "clock"));

Imu imuOn(const Motion& motion, const ImuOptions& options) {
  return Imu(motion, kImuPlace, options, kImuClock, Noise(7, "imu"));
}

struct State {
  Quaterniond q;
  Vector3d v, p;
};

// The fourth order rule over two periods of the measurements: begin, middle, end.
State rungeKutta(const State& s, const ImuMeasurement& begin, const ImuMeasurement& middle, const ImuMeasurement& end,
                 double dt) {
  const auto change = [](const State& state, const ImuMeasurement& measured) {
    const Quaterniond turn(0.0, measured.rate.x(), measured.rate.y(), measured.rate.z());
    Eigen::Matrix<double, 10, 1> all;
    all << 0.5 * (state.q * turn).coeffs(), state.q * measured.specific_force - Vector3d(0, 0, kGravity), state.v;
    return all;
  };
  const auto stepped = [&](const Eigen::Matrix<double, 10, 1>& by, double h) {
    return State{Quaterniond(Eigen::Vector4d(s.q.coeffs() + h * by.head<4>())), s.v + h * by.segment<3>(4),
                 s.p + h * by.tail<3>()};
  };
  const auto k1 = change(s, begin), k2 = change(stepped(k1, dt / 2), middle), k3 = change(stepped(k2, dt / 2), middle),
             k4 = change(stepped(k3, dt), end);
  State next = stepped(((k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0).eval(), dt);
  next.q.normalize();
  return next;
}

Pose imuPose(const Motion& motion, double t) { return motion.at(t).T_world_base * kImuPlace; }

State trueState(const Motion& motion, double t) {
  const MotionState motion_state = motion.at(t);
  const Pose pose = motion_state.T_world_base * kImuPlace;
  return {pose.q(),
          motion_state.velocity_world + motion_state.T_world_base.q() * motion_state.rate_base.cross(kImuPlace.t()),
          pose.t()};
}

TEST(Imu, IntegratedWithoutNoiseItReturnsToTheTruePose) {
  const auto motion = testMotion(100.0);
  const Imu imu = imuOn(*motion, perfectImu());
  const Schedule schedule = sensorSchedule(Sensor::Imu);
  for (const std::int64_t first : {1, 1000, 3000, 5500, 8000}) {
    State state = trueState(*motion, schedule.at(first));
    std::int64_t k = first;
    for (; k < first + 1000; k += 2)
      state = rungeKutta(state, imu.at(k), imu.at(k + 1), imu.at(k + 2), 2 * schedule.period);
    const Pose truth = imuPose(*motion, schedule.at(k));
    EXPECT_LT((state.p - truth.t()).norm(), 1e-3) << first;
    EXPECT_LT(state.q.angularDistance(truth.q()), 1e-5) << first;
  }
}

TEST(Imu, AtRestItMeasuresGravityOnly) {
  const auto motion = testMotion(5.0, false);
  const ImuMeasurement measured = imuOn(*motion, perfectImu()).at(0);
  const Vector3d up = kImuPlace.q().conjugate() * Vector3d(0, 0, kGravity);
  EXPECT_LT((measured.specific_force - up).norm(), 0.25);
  EXPECT_LT(measured.rate.norm(), 0.05);
  EXPECT_NEAR(measured.field.norm(), earthField().norm(), 1e-12);
}

TEST(Imu, FieldPointsNorthAndDown) {
  EXPECT_NEAR(std::atan2(-earthField().x(), earthField().y()), 2.5 * M_PI / 180.0, 1e-9);
  EXPECT_LT(earthField().z(), 0.0);
}

TEST(Imu, WhiteNoiseHasItsDensity) {
  const auto motion = testMotion(100.0);
  ImuOptions options = perfectImu();
  options.rate_density = ImuOptions{}.rate_density;
  options.force_density = ImuOptions{}.force_density;
  const Imu noisy = imuOn(*motion, options), perfect = imuOn(*motion, perfectImu());
  double rates = 0.0, forces = 0.0;
  constexpr int kMany = 9000;
  for (int k = 0; k < kMany; ++k) {
    rates += (noisy.at(k).rate - perfect.at(k).rate).squaredNorm() / (3.0 * kMany);
    forces += (noisy.at(k).specific_force - perfect.at(k).specific_force).squaredNorm() / (3.0 * kMany);
  }
  EXPECT_NEAR(std::sqrt(rates), 0.1 * M_PI / 180.0 * 10.0, 0.02 * 0.1 * M_PI / 180.0 * 10.0);
  EXPECT_NEAR(std::sqrt(forces), 0.01, 0.0002);
}

TEST(Imu, BiasesDriftSlowly) {
  const auto motion = testMotion(300.0);
  ImuOptions options = perfectImu();
  options.rate_bias = options.rate_walk = 1e-3;
  options.force_bias = 0.02;
  const Imu drifting = imuOn(*motion, options), perfect = imuOn(*motion, perfectImu());
  const auto off = [&](std::int64_t k) { return Vector3d(drifting.at(k).rate - perfect.at(k).rate); };
  EXPECT_GT(off(0).norm(), 1e-5);
  EXPECT_LT((off(100) - off(0)).norm(), 5e-3);
  EXPECT_GT((off(29000) - off(0)).norm(), 5e-3);  // sqrt(290) * 1e-3 an axis
  EXPECT_LT((drifting.at(29000).specific_force - perfect.at(29000).specific_force).norm(), 0.15);
}

TEST(Imu, StatedNoiseIsSmallRelativeToTheBoundOfTheGyroscope) {
  const auto motion = testMotion(60.0);
  const Imu noisy = imuOn(*motion, ImuOptions{});
  double square = 0.0;
  for (int k = 0; k < 5000; ++k) {
    square += (noisy.at(k).rate - noisy.truth(sensorSchedule(Sensor::Imu).at(k)).rate).squaredNorm() / (3.0 * 5000);
  }
  EXPECT_LT(std::sqrt(square), 0.03);  // rad/s
  EXPECT_GT(std::sqrt(square), 0.01);
}

TEST(Imu, ErrorsAreAMatrixABiasAndNothingElse) {
  const auto motion = testMotion(20.0);
  ImuOptions options = perfectImu();
  options.rate_offset = 0.05;
  options.force_offset = 0.2;
  options.scale_sigma = 0.01;
  options.axes_sigma = 0.003;
  const Imu imu = imuOn(*motion, options), perfect = imuOn(*motion, perfectImu());
  EXPECT_EQ(perfect.rateMatrix(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(perfect.rateBias(3.0), Vector3d::Zero());
  EXPECT_GT((imu.rateMatrix() - Eigen::Matrix3d::Identity()).norm(), 1e-3);
  EXPECT_GT((imu.rateMatrix() - imu.forceMatrix()).norm(), 1e-3);
  EXPECT_GT(imu.rateBias(0.0).norm(), 0.005);
  EXPECT_LE(imu.rateBias(0.0).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LE(imu.forceBias(0.0).cwiseAbs().maxCoeff(), 0.2);
  for (std::int64_t k = 0; k < 1000; k += 37) {
    const double t = sensorSchedule(Sensor::Imu).at(k);
    const ImuMeasurement truth = perfect.at(k), measured = imu.at(k);
    EXPECT_LT((measured.rate - imu.rateMatrix() * truth.rate - imu.rateBias(t)).norm(), 1e-12);
    EXPECT_LT((measured.specific_force - imu.forceMatrix() * truth.specific_force - imu.forceBias(t)).norm(), 1e-12);
  }
}

TEST(Imu, MistakesOfDriversChangeUnitsAndAxes) {
  const auto motion = testMotion(20.0);
  const auto measure = [&](const ImuMistakes& mistakes) {
    ImuOptions options = perfectImu();
    options.mistakes = mistakes;
    return Imu(*motion, Pose(), options, kImuClock, Noise(7, "imu")).at(700);
  };
  const ImuMeasurement truth = measure({});
  const ImuMeasurement exchanged = measure({true, false, false, false});
  EXPECT_EQ(exchanged.rate, Vector3d(truth.rate.y(), truth.rate.x(), truth.rate.z()));
  EXPECT_EQ(exchanged.specific_force.x(), truth.specific_force.y());
  const ImuMeasurement degrees = measure({false, true, false, false});
  EXPECT_NEAR((degrees.rate * M_PI / 180.0 - truth.rate).norm(), 0.0, 1e-12);
  EXPECT_EQ(degrees.specific_force, truth.specific_force);
  const ImuMeasurement ned = measure({false, false, true, false});
  EXPECT_EQ(ned.rate, Vector3d(truth.rate.x(), -truth.rate.y(), -truth.rate.z()));
  EXPECT_LT(ned.specific_force.z(), -9.0);
  const ImuMeasurement free = measure({false, false, false, true});
  EXPECT_LT(free.specific_force.norm(), 3.0);
  EXPECT_EQ(free.rate, truth.rate);
}

}  // namespace
}  // namespace urban_nav_sim
