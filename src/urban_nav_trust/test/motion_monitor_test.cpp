// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/motion_monitor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace urban_nav_trust {
namespace {

constexpr urban_nav_core::StampNs kStep = 50'000'000;

/// Robot at 1 m/s, whose sensors differ by noise and by the given errors.
class MeasuredDrive {
 public:
  explicit MeasuredDrive(unsigned seed) : random_(seed) {}
  double yaw = 0.0, jump = 0.0, turn_scale = 0.0, slip = 0.0, delay = 0.01, wheel_delay = 0.0;
  std::string gyroscope_fault, wheels_fault;

  void drive(MotionMonitor& monitor, double seconds) {
    for (int i = 0; i < std::lround(20.0 * seconds); ++i) {
      urban_nav_core::FrameMeasurements frame;
      frame.stamp = ++k_ * kStep;
      frame.turn_sigma = 5e-4;
      frame.turn_error = 5e-4 * Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_));
      frame.turn = Eigen::Vector3d(0.0, 0.0, 0.03 * std::sin(0.02 * static_cast<double>(k_)));
      frame.turn_error += turn_scale * frame.turn;
      frame.turn_error.z() += jump;
      jump = 0.0;
      frame.forward_sigma = 2e-3;
      frame.forward = 0.05 + 2e-3 * normal_(random_);
      frame.forward_error = 0.05 * slip + 2e-3 * normal_(random_);
      frame.sideways = 0.05 * std::tan(yaw) + 2e-3 * normal_(random_);
      frame.imu_delay = delay + 1e-3 * normal_(random_);
      frame.imu_delay_sigma = frame.wheel_delay_sigma = 1e-3;
      frame.wheel_delay = wheel_delay;
      frame.gyroscope_fault = gyroscope_fault;
      frame.wheels_fault = wheels_fault;
      urban_nav_core::RelativePose step;
      step.drift_covariance = urban_nav_core::Matrix6d::Zero();
      step.drift_covariance.diagonal() << 1e-8, 1e-8, 1e-8, 1e-12, 1e-12, 1e-12;
      monitor.add(step);
      monitor.add(frame);
    }
  }
  urban_nav_core::StampNs now() const { return k_ * kStep; }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  urban_nav_core::StampNs k_ = 0;
};

std::vector<std::string> failedNames(const MotionMonitor& monitor) {
  std::vector<std::string> names;
  for (const ConsistencyTest& test : monitor.tests())
    if (test.p_value < Parameters().false_alarm) names.push_back(test.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(MotionMonitor, IsSilentInFiftyDrivesOfAMinute) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    MotionMonitor monitor({});
    MeasuredDrive(seed).drive(monitor, 60.0);
    EXPECT_EQ(failedNames(monitor), Names()) << seed;
    EXPECT_EQ(monitor.tests().size(), 4U);
    EXPECT_TRUE(monitor.absent().empty());
  }
}

TEST(MotionMonitor, IsEvidenceOfOdometrysCovarianceOfTurnsAndLengths) {
  MotionMonitor monitor({});
  EXPECT_TRUE(monitor.turnEvidence().isEmpty());
  MeasuredDrive(1).drive(monitor, 60.0);
  EXPECT_FALSE(monitor.turnEvidence().isEmpty());
  EXPECT_FALSE(monitor.lengthEvidence().isEmpty());
  // With 4.5 urad per second stated and 2.2 mrad of noise, a factor of 20 would not be detectable.
  EXPECT_NEAR(monitor.turnEvidence().probabilities()[kScaleCount - 1], 1.0 / kScaleCount, 0.05);
}

TEST(MotionMonitor, NamesWhatHasChangedAndWhen) {
  const auto check = [](const char* name, const auto& change) {
    MotionMonitor monitor({});
    MeasuredDrive drive(7);
    drive.drive(monitor, 20.0);
    const urban_nav_core::StampNs at = drive.now();
    change(drive);
    drive.drive(monitor, 20.0);
    EXPECT_EQ(failedNames(monitor), Names{name});
    for (const ConsistencyTest& test : monitor.tests())
      if (test.name == name) {
        EXPECT_LT(std::abs(urban_nav_core::secondsBetween(at, test.interval.from)), 2.6) << name;
        EXPECT_FALSE(test.remedy.empty());
      }
  };
  check(kTurnTest, [](MeasuredDrive& drive) { drive.jump = 0.035; });
  check(kSpeedTest, [](MeasuredDrive& drive) { drive.slip = 0.1; });
  check(kDirectionTest, [](MeasuredDrive& drive) { drive.yaw = 0.035; });
  check(kClockTest, [](MeasuredDrive& drive) { drive.delay = 0.06; });
}

const ConsistencyTest* find(const std::vector<ConsistencyTest>& tests, const char* name) {
  const auto found = std::find_if(tests.begin(), tests.end(), [&](const auto& test) { return test.name == name; });
  return found == tests.end() ? nullptr : &*found;
}

TEST(MotionMonitor, FailsForASensorThatOdometryExcludesAndStatesWhenItIsUsedAgain) {
  for (const bool is_wheels : {false, true}) {
    const char* name = is_wheels ? kSpeedTest : kTurnTest;
    MotionMonitor monitor({});
    MeasuredDrive drive(3);
    std::string& fault = is_wheels ? drive.wheels_fault : drive.gyroscope_fault;
    drive.drive(monitor, 10.0);
    const urban_nav_core::StampNs begin = drive.now();
    fault = "messages are stamped 0.3 s too early: set the clock of the device";
    drive.drive(monitor, 5.0);
    const urban_nav_core::StampNs end = drive.now();
    EXPECT_EQ(failedNames(monitor), Names{name});
    std::vector<ConsistencyTest> tests = monitor.tests();
    EXPECT_FALSE(find(tests, name)->is_corrected);
    EXPECT_NE(find(tests, name)->sentence.find(fault), std::string::npos);
    fault.clear();
    drive.drive(monitor, 5.0);
    tests = monitor.tests();
    ASSERT_EQ(failedNames(monitor), Names{name});
    EXPECT_TRUE(find(tests, name)->is_corrected);
    EXPECT_EQ(find(tests, name)->interval.from, begin);
    EXPECT_EQ(find(tests, name)->interval.to, end);
  }
}

TEST(MotionMonitor, NamesAScaleOfTurnsButNotAKnock) {
  const auto sentenceFor = [](double scale, double jump) {
    MotionMonitor monitor({});
    MeasuredDrive drive(11);
    drive.turn_scale = scale;
    drive.drive(monitor, 20.0);
    drive.jump = jump;
    drive.drive(monitor, 20.0);
    EXPECT_EQ(failedNames(monitor), Names{kTurnTest});
    const std::vector<ConsistencyTest> tests = monitor.tests();
    return find(tests, kTurnTest)->sentence;
  };
  const std::string scaled = sentenceFor(-0.03, 0.0), words = "scale: those by stereo are ";
  ASSERT_NE(scaled.find(words), std::string::npos) << scaled;
  EXPECT_NEAR(std::stod(scaled.substr(scaled.find(words) + words.size())), 3.0, 0.1);
  EXPECT_EQ(sentenceFor(0.0, 0.05).find("scale"), std::string::npos);
}

TEST(MotionMonitor, ADelayLongerThanATransferIsAClockThatIsWrong) {
  const auto sentenceFor = [](double imu, double wheels) {
    MotionMonitor monitor({});
    MeasuredDrive drive(5);
    drive.delay = imu;
    drive.wheel_delay = wheels;
    drive.drive(monitor, 20.0);
    const std::vector<ConsistencyTest> tests = monitor.tests();
    const ConsistencyTest* test = find(tests, kClockTest);
    EXPECT_EQ(test->p_value<Parameters().false_alarm, std::abs(imu)> 0.06) << imu;
    return test->sentence;
  };
  sentenceFor(0.04, 0.0);
  sentenceFor(-0.04, -0.04);
  EXPECT_EQ(sentenceFor(0.1, 0.0).find("The IMU's stamps are "), 0U);
  EXPECT_EQ(sentenceFor(-0.1, -0.095).find("The stamps of the cameras are "), 0U) << "two sensors against one";
}

TEST(MotionMonitor, WithoutSensorsOrWithNumbersThatAreNoneTestsAreAbsent) {
  MotionMonitor monitor({});
  urban_nav_core::FrameMeasurements frame;
  for (int i = 0; i < 100; ++i) {
    frame.stamp += kStep;
    frame.turn_error.setConstant(std::numeric_limits<double>::quiet_NaN());
    frame.turn_sigma = frame.forward_sigma = i % 2 == 0 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    frame.imu_delay_sigma = 0.05;  // the prior
    EXPECT_FALSE(monitor.add(frame));
  }
  EXPECT_TRUE(monitor.tests().empty());
  EXPECT_EQ(monitor.absent().size(), 4U);
}

}  // namespace
}  // namespace urban_nav_trust
