// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/motion/motion_sensors.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <functional>

#include "drive.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace urban_nav_core {
namespace {

constexpr int kMotionFrame = 50;  // ms

const LevelDrive& longDrive() {
  static const LevelDrive drive(45.0);
  return drive;
}

using Change = std::function<void(MotionInput&, int ms)>;

/// Frames of a drive with its sensors, up to a time. Frames settle ten frames later.
class Play {
 public:
  explicit Play(const DriveErrors& errors, unsigned seed = 1, Change change = {}, bool wheels = true)
      : sensors_(longDrive(), errors, seed), change_(std::move(change)), with_wheels_(wheels) {}

  void until(int end_ms) {
    for (; now_ + kMotionFrame <= end_ms; now_ += kMotionFrame) {
      feed(now_ + kMotionFrame);
      motion.addFrame(frame_, 1e-3 * kMotionFrame, true, false);
      MeasuredStep exact;
      exact.step.from = now_ * kMillisecond;
      exact.step.to = (now_ + kMotionFrame) * kMillisecond;
      exact.step.T_from_to = longDrive().between(now_, now_ + kMotionFrame);
      motion.check(exact);
      MeasuredStep settled = sensors_.step(frame_, now_, now_ + kMotionFrame);
      if (frame_++ == 0) settled.step.from = settled.step.to;
      pending_.push_back(settled);
      if (pending_.size() <= 10) continue;
      motion.learn(pending_.front());
      pending_.pop_front();
    }
  }

  /// Advances without the reference, and returns the prediction.
  std::optional<Reckoned> outage(int end_ms) {
    const int from = now_;
    feed(end_ms);
    now_ = end_ms;
    return motion.predict(from * kMillisecond, end_ms * kMillisecond, longDrive().at(from).q());
  }

  int now() const { return now_; }
  MotionSensors motion;

 private:
  void feed(int end_ms) {
    std::vector<MotionInput> inputs;
    for (; rates_ + 10 <= end_ms; rates_ += 10) {
      inputs.push_back(sensors_.gyroscope(rates_));
      if (change_) change_(inputs.back(), rates_);
    }
    for (; with_wheels_ && rolls_ + 40 <= end_ms; rolls_ += 40) {
      inputs.push_back(sensors_.wheels(rolls_));
      if (change_) change_(inputs.back(), rolls_);
    }
    motion.add(inputs);
  }

  DriveSensors sensors_;
  Change change_;
  bool with_wheels_;
  int now_ = 0, rates_ = 0, rolls_ = 0;
  std::int64_t frame_ = 0;
  std::deque<MeasuredStep> pending_;
};

TEST(MotionSensors, FindBiasScaleAndDelayWithinTenSeconds) {
  DriveErrors errors;
  errors.bias = {0.02, -0.05, 0.1};
  errors.speed_scale = 1.03;
  errors.turn_scale = 0.97;
  errors.imu_delay_ms = 20;
  Play play(errors);
  play.until(10'000);
  const MotionEstimates& found = play.motion.estimates();
  EXPECT_TRUE(found.uses_gyroscope);
  EXPECT_TRUE(found.uses_wheels);
  EXPECT_TRUE(found.faults.empty());
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs(found.gyroscope_bias[i] - errors.bias[i]), 3.0 * found.gyroscope_bias_sigma[i]) << i;
    EXPECT_LT(found.gyroscope_bias_sigma[i], 0.002);
  }
  EXPECT_LT(std::abs(found.wheel_scale - errors.speed_scale), 3.0 * found.wheel_scale_sigma);
  EXPECT_LT(found.wheel_scale_sigma, 0.005);
  EXPECT_LT(std::abs(found.wheel_turn_scale - errors.turn_scale), 3.0 * found.wheel_turn_scale_sigma);
  EXPECT_LT(std::abs(found.imu_offset_s - 0.02), 3.0 * found.imu_offset_sigma_s);
  EXPECT_LT(found.imu_offset_sigma_s, 0.005);
}

TEST(MotionSensors, BiasIsStatedInTheAxesOfTheImu) {
  DriveErrors errors;
  errors.bias = {0.0, 0.0, 0.08};
  const Eigen::Quaterniond q_base_imu(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitX()));
  Play play(errors, 2, [&](MotionInput& input, int) { input.q_base_sensor = q_base_imu; });
  play.until(10'000);
  const Eigen::Vector3d expected = q_base_imu.conjugate() * errors.bias;
  EXPECT_LT((play.motion.estimates().gyroscope_bias - expected).norm(), 0.005);
  EXPECT_GT(expected.y(), 0.07);
}

// 2.5 s without the reference while turning: the error corresponds to the covariance, over many draws of all errors.
TEST(MotionSensors, OutageIsBridgedWithTheCovarianceOfThePrediction) {
  constexpr int kDraws = 24;
  double nees = 0.0, worst_m = 0.0, worst_rad = 0.0;
  for (unsigned seed = 1; seed <= kDraws; ++seed) {
    DriveErrors errors;
    errors.bias = {0.01, -0.02, 0.03};
    errors.speed_scale = 1.01;
    Play play(errors, seed);
    play.until(12'000);
    const int from = play.now();
    const std::optional<Reckoned> u = play.outage(from + 2500);
    ASSERT_TRUE(u);
    const Pose truth = longDrive().between(from, from + 2500);
    const Vector6d e = boxMinus(truth, u->T_from_to);
    nees += e.dot(SmallCholesky<6>(u->covariance).solve(e)) / kDraws;
    worst_m = std::max(worst_m, distanceBetween(truth, u->T_from_to));
    worst_rad = std::max(worst_rad, angleBetween(truth, u->T_from_to));
  }
  // Lateral and vertical slip are allowed for real ground, but do not occur here.
  EXPECT_GT(nees, 1.5);
  EXPECT_LT(nees, 8.0);
  EXPECT_LT(worst_m, 0.06);
  EXPECT_LT(worst_rad, 0.015);
}

TEST(MotionSensors, WithoutWheelsTheRotationGoesOnAndTheTranslationIsUnknown) {
  Play play(DriveErrors(), 3, {}, false);
  play.until(12'000);
  const int from = play.now();
  const std::optional<Reckoned> u = play.outage(from + 2500);
  ASSERT_TRUE(u);
  EXPECT_FALSE(u->has_translation);
  const Pose truth = longDrive().between(from, from + 2500);
  const Eigen::Vector3d e = boxMinus(truth, Pose(u->T_from_to.q(), truth.t())).tail<3>();
  EXPECT_LT(e.dot(SmallCholesky<3>(Matrix3d(u->covariance.bottomRightCorner<3, 3>())).solve(e)),
            16.3);  // 99.9 % of 3 degrees of freedom
}

// Common errors of the steps of an outage accumulate as over a single step.
TEST(MotionSensors, StepsOfAChainAreAsUncertainAsItIs) {
  DriveErrors errors;
  errors.bias = {0.0, 0.0, 0.05};
  Play whole(errors, 4, {}, false), steps(errors, 4, {}, false);
  whole.until(3000);
  steps.until(3000);
  const int from = whole.now();
  const double one = whole.outage(from + 2500)->covariance.bottomRightCorner<3, 3>().diagonal().mean();
  double sum = 0.0;
  for (int i = 0; i < 50; ++i) {
    const std::optional<Reckoned> u = steps.outage(from + 50 * (i + 1));
    ASSERT_TRUE(u);
    sum += u->covariance.bottomRightCorner<3, 3>().diagonal().mean();
    steps.motion.addFrame(1000 + i, 0.05, false, true);
  }
  EXPECT_NEAR(sum / one, 1.0, 0.2);
}

struct WrongSensor {
  const char* what;
  Change change;
  const char* words;  // expected in the sentence
};

class WrongGyroscope : public ::testing::TestWithParam<WrongSensor> {};

Change turned(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
  return [map](MotionInput& input, int) {
    if (input.source != MotionSource::Gyroscope) return;
    input.T_from_to = Pose(expSo3(map(logSo3(input.T_from_to.q()))), Eigen::Vector3d::Zero());
  };
}

TEST_P(WrongGyroscope, IsLeftOutAndNamed) {
  Play play(DriveErrors(), 5, GetParam().change);
  play.until(15'000);
  const MotionEstimates& found = play.motion.estimates();
  EXPECT_FALSE(found.uses_gyroscope);
  EXPECT_TRUE(found.gyroscope_left_out);
  EXPECT_TRUE(found.uses_wheels);
  ASSERT_FALSE(found.faults.empty());
  EXPECT_FALSE(found.faults.back().is_wheels);
  EXPECT_NE(found.faults.back().sentence.find(GetParam().words), std::string::npos) << found.faults.back().sentence;
}

INSTANTIATE_TEST_SUITE_P(
    MotionSensors, WrongGyroscope,
    ::testing::Values(
        WrongSensor{"Axes", turned([](const auto& w) { return Eigen::Vector3d(w.z(), w.x(), w.y()); }), "y,z,x"},
        WrongSensor{"Ned", turned([](const auto& w) { return Eigen::Vector3d(w.x(), -w.y(), -w.z()); }), "x,-y,-z"},
        WrongSensor{"Degrees", turned([](const auto& w) -> Eigen::Vector3d { return w * 180.0 / M_PI; }), "degrees"},
        WrongSensor{"Scale", turned([](const auto& w) -> Eigen::Vector3d { return 1.3 * w; }), "scale"},
        WrongSensor{"Bias",
                    turned([](const auto& w) -> Eigen::Vector3d { return w + Eigen::Vector3d(0.0, 0.0, 0.003); }),
                    "bias"},
        WrongSensor{"Frozen",
                    [last = Pose()](MotionInput& input, int ms) mutable {
                      if (input.source != MotionSource::Gyroscope) return;
                      if (ms < 6000) last = input.T_from_to;
                      input.T_from_to = last;
                    },
                    "frozen"},
        WrongSensor{"Late",
                    [](MotionInput& input, int) {
                      if (input.source != MotionSource::Gyroscope) return;
                      input.from += 1000 * kMillisecond;
                      input.to += 1000 * kMillisecond;
                    },
                    "late"}),
    [](const auto& instance) { return std::string(instance.param.what); });

// Frames settle half a second later; until then a faulty sensor must not affect the prediction.
TEST(MotionSensors, ThatGoWrongPredictNothingFromTheFirstStepOn) {
  const auto exchanged = turned([](const auto& w) { return Eigen::Vector3d(w.y(), w.z(), w.x()); });
  Play play(
      DriveErrors(), 8,
      [&](MotionInput& input, int ms) {
        if (ms >= 10'000) exchanged(input, ms);
      },
      false);
  play.until(10'000);
  EXPECT_TRUE(play.motion.estimates().uses_gyroscope);
  play.until(10'000 + 2 * kMotionFrame);
  EXPECT_TRUE(play.motion.estimates().uses_gyroscope);  // fault not yet detected
  EXPECT_FALSE(play.outage(play.now() + kMotionFrame));
}

TEST(MotionSensors, ThatRepeatTheirNumbersPredictNothing) {
  Play play(
      DriveErrors(), 9,
      [last = Pose()](MotionInput& input, int ms) mutable {
        if (ms < 10'000) last = input.T_from_to;
        input.T_from_to = last;
      },
      false);
  play.until(9'990);
  EXPECT_TRUE(play.motion.estimates().uses_gyroscope);
  EXPECT_FALSE(play.outage(10'500));
}

TEST(MotionSensors, BeforeTheyHaveMovedPredictNothing) {
  MotionSensors motion;
  for (int i = 0; i < 100; ++i) {
    std::vector<MotionInput> rest(5);
    for (int k = 0; k < 5; ++k) {
      MotionInput& input = rest[static_cast<std::size_t>(k)];
      input.source = MotionSource::Gyroscope;
      input.from = (kMotionFrame * i + 10 * k) * kMillisecond;
      input.to = input.from + 10 * kMillisecond;
      input.T_from_to = Pose(expSo3(Eigen::Vector3d(0.0, 0.0, 1e-6 * ((7 * i + k) % 5))), Eigen::Vector3d::Zero());
    }
    motion.add(rest);
    motion.addFrame(i, 1e-3 * kMotionFrame, true, false);
    MeasuredStep settled;
    settled.frame = i;
    settled.stamp = settled.step.to = (i + 1) * kMotionFrame * kMillisecond;
    settled.step.from = i == 0 ? settled.stamp : i * kMotionFrame * kMillisecond;
    settled.step.covariance = settled.step.drift_covariance = 1e-8 * Matrix6d::Identity();
    motion.learn(settled);
  }
  EXPECT_TRUE(motion.estimates().has_gyroscope);
  EXPECT_FALSE(motion.estimates().uses_gyroscope);
  EXPECT_TRUE(motion.estimates().faults.empty());
  EXPECT_LT(motion.estimates().gyroscope_bias_sigma.maxCoeff(), 0.002);  // estimated from rest
}

TEST(MotionSensors, WheelsOfAnotherRadiusAreLeftOutAndNamed) {
  DriveErrors errors;
  errors.speed_scale = 1.3;
  Play play(errors, 6);
  play.until(10'000);
  const MotionEstimates& found = play.motion.estimates();
  EXPECT_FALSE(found.uses_wheels);
  EXPECT_TRUE(found.wheels_left_out);
  EXPECT_TRUE(found.uses_gyroscope);
  ASSERT_FALSE(found.faults.empty());
  EXPECT_NE(found.faults.front().sentence.find("radius of the wheels"), std::string::npos)
      << found.faults.front().sentence;
}

TEST(MotionSensors, ASensorThatAgreesAgainIsUsedAgain) {
  const auto exchanged = turned([](const auto& w) { return Eigen::Vector3d(w.y(), w.z(), w.x()); });
  Play play(DriveErrors(), 7, [&](MotionInput& input, int ms) {
    if (ms > 6000 && ms < 12'000) exchanged(input, ms);
  });
  play.until(6000);
  EXPECT_TRUE(play.motion.estimates().uses_gyroscope);
  play.until(12'000);
  EXPECT_FALSE(play.motion.estimates().uses_gyroscope);
  play.until(40'000);
  EXPECT_TRUE(play.motion.estimates().uses_gyroscope);
  ASSERT_FALSE(play.motion.estimates().faults.empty());
  EXPECT_GT(play.motion.estimates().faults.back().until, 0);
}

TEST(MotionSensors, GoOnFromTheirState) {
  Play one{DriveErrors()}, other{DriveErrors()};
  one.until(8000);
  other.until(8000);
  Archive writer;
  writer(other.motion);
  const std::string state = writer.take();
  other.motion = MotionSensors();
  Archive reader(state, "state");
  reader(other.motion);
  reader.finish();
  one.until(12'000);
  other.until(12'000);
  const auto a = one.outage(14'000), b = other.outage(14'000);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->covariance, b->covariance);
  EXPECT_EQ(a->T_from_to.t(), b->T_from_to.t());
}

TEST(MotionSensors, WithoutStatementsNothingIsPredicted) {
  MotionSensors motion;
  motion.add({MotionInput()});
  motion.addFrame(0, 0.0, true, false);
  EXPECT_FALSE(motion.predict(0, 50 * kMillisecond, Quaterniond::Identity()));
  EXPECT_FALSE(motion.estimates().has_gyroscope || motion.estimates().has_wheels);
}

}  // namespace
}  // namespace urban_nav_core
