// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/motion_examination.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_input/sensors/ground_finding.hpp"

namespace urban_nav_input {
namespace {

using Options = std::vector<std::string>;
using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

constexpr StampNs kFirstSeen = 1'500'000'000'000'000'000, kStep = 20'000'000;
constexpr double kSpeed = 1.2;  // m/s

double heading(double t) { return 0.6 * (1.0 - std::cos(0.5 * t)); }

/// Findings of 30 s of a drive with turns, of which stereo sees an interval every second.
std::vector<Finding> examine(double wheels_scale, double turn_scale, double gyroscope_scale, double stereo_sees = 1.0) {
  MotionExamination examination;
  for (int i = 0; i < 1500; ++i) {
    const StampNs stamp = kFirstSeen + i * kStep;
    const double t = 0.02 * i;
    examination.addWheels(stamp, {{wheels_scale * kSpeed * t, 0.0, 0.0}}, kSpeed);
    examination.addGyroscope(stamp, gyroscope_scale * 0.3 * std::sin(0.5 * t));
  }
  MotionExamination turning;  // on the spot
  for (int i = 0; i < 1500; ++i) {
    const double t = 0.02 * i;
    turning.addWheels(kFirstSeen + i * kStep, {{0.0, 0.0, turn_scale * heading(t)}}, 0.0);
  }
  std::vector<SeenMotion> seen;
  for (int second = 1; second < 29; ++second) {
    const StampNs from = kFirstSeen + second * StampNs{1'000'000'000} + 3'000'000;
    const double t = second + 0.003, turn = heading(t + 0.2) - heading(t);
    seen.push_back({from, from + 200'000'000,
                    Pose(Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ())),
                         Vector3d(stereo_sees * 0.2 * kSpeed * (1.0 + 0.05 * (second % 3 - 1)), 0.0, 0.0))});
  }
  std::vector<Finding> findings = examination.findings(seen, "/wheels", "/imu", {});
  for (Finding& finding : turning.findings(seen, "/wheels", "", {})) findings.push_back(std::move(finding));
  return findings;
}

TEST(MotionExamination, FindsNothingWhereSensorsAgree) {
  EXPECT_TRUE(examine(1.0, 1.0, 1.0).empty());
  EXPECT_TRUE(examine(1.1, 1.0, 0.95).empty()) << "worn tyres";
}

/// Findings of a minute of a robot that turns irregularly, with stamps that are late by these times, s.
std::vector<Finding> withDelays(double imu_late, double wheels_late, double bias = 0.05) {
  const auto turned = [](double t) { return 0.3 * std::sin(0.7 * t) + 0.2 * std::sin(1.9 * t + 1.0); };
  const auto rate = [](double t) { return 0.21 * std::cos(0.7 * t) + 0.38 * std::cos(1.9 * t + 1.0); };
  MotionExamination examination;
  const auto toStamp = [](double t) { return kFirstSeen + static_cast<StampNs>(std::llround(1e9 * t)); };
  for (int i = 0; i < 6000; ++i) examination.addGyroscope(toStamp(0.01 * i + imu_late), rate(0.01 * i) + bias);
  for (int i = 0; i < 1800; ++i) {
    const double t = i / 30.0;
    examination.addWheels(toStamp(t + wheels_late), {{kSpeed * t, 0.0, turned(t)}}, kSpeed);
  }
  std::vector<SeenMotion> seen;
  for (int second = 2; second < 57; ++second) {
    const double t = second + 0.003, noise = 2e-3 * std::sin(37.0 * second);
    seen.push_back({toStamp(t), toStamp(t + 0.2),
                    Pose(Quaterniond(Eigen::AngleAxisd(turned(t + 0.2) - turned(t) + noise, Vector3d::UnitZ())),
                         Vector3d(0.2 * kSpeed, 0.0, 0.0))});
  }
  return examination.findings(seen, "/wheels", "/imu", {});
}

TEST(MotionExamination, StatesWhoseStampsAreLate) {
  EXPECT_TRUE(withDelays(0.0, 0.0).empty());
  EXPECT_TRUE(withDelays(0.04, -0.04).empty()) << "as long as a transfer takes";
  const auto expectDelay = [](const Finding& finding, std::size_t option, const std::string& name, double ms) {
    ASSERT_GT(finding.options.size(), option);
    ASSERT_EQ(finding.options[option].find("input." + name + "="), 0U) << finding.options[option];
    EXPECT_NEAR(std::stod(finding.options[option].substr(name.size() + 7)), ms, 10.0) << finding.text;
  };
  const std::vector<Finding> imu = withDelays(0.2, 0.0);
  ASSERT_EQ(imu.size(), 1U);
  EXPECT_EQ(imu[0].kind, FindingKind::Stamps);
  expectDelay(imu[0], 1, "imu_delay", 200.0);
  EXPECT_EQ(imu[0].options.size(), 2U);
  expectDelay(withDelays(0.0, 0.1).at(0), 1, "wheels_delay", 100.0);
  const std::vector<Finding> images = withDelays(-0.1, -0.1);
  ASSERT_EQ(images.size(), 1U);
  EXPECT_EQ(images[0].text.find("the stamps of the images are 0."), 0U) << images[0].text;
  EXPECT_NE(images[0].text.find("s later"), std::string::npos) << images[0].text;
  expectDelay(images[0], 1, "imu_delay", -100.0);
  expectDelay(images[0], 3, "wheels_delay", -100.0);
}

TEST(MotionExamination, StatesScaleAndSignOfWheels) {
  const std::vector<Finding> millimetres = examine(1000.0, 1.0, 1.0);
  ASSERT_EQ(millimetres.size(), 1U);
  EXPECT_EQ(millimetres[0].kind, FindingKind::Wheels);
  EXPECT_NE(millimetres[0].text.find("millimetres"), std::string::npos) << millimetres[0].text;
  EXPECT_EQ(millimetres[0].options, (Options{"--set", "input.wheels_scale=0.001"}));
  EXPECT_EQ(examine(-1.0, 1.0, 1.0)[0].options, (Options{"--set", "input.wheels_scale=-1"}));
  const std::vector<Finding> half = examine(0.5, 1.0, 1.0);
  ASSERT_EQ(half.size(), 1U);
  EXPECT_EQ(half[0].options, (Options{"--set", "input.wheels_scale=2"}));
  const std::vector<Finding> clockwise = examine(1.0, -1.0, 1.0);
  ASSERT_EQ(clockwise.size(), 1U);
  EXPECT_NE(clockwise[0].text.find("clockwise"), std::string::npos) << clockwise[0].text;
}

TEST(MotionExamination, StatesTheScaleOfTheGyroscope) {
  const std::vector<Finding> degrees = examine(1.0, 1.0, 180.0 / M_PI);
  ASSERT_EQ(degrees.size(), 1U);
  EXPECT_EQ(degrees[0].kind, FindingKind::Imu);
  ASSERT_EQ(degrees[0].options.size(), 2U) << degrees[0].text;
  EXPECT_EQ(degrees[0].options[1].substr(0, 28), "input.gyroscope_scale=0.0174");
  const std::vector<Finding> turned = examine(1.0, 1.0, -1.0);
  ASSERT_EQ(turned.size(), 1U);
  EXPECT_NE(turned[0].text.find("wrong sign"), std::string::npos) << turned[0].text;
}

/// Findings of a drive in which stereo sees turns of 8 mrad with errors of 1 mrad.
std::vector<Finding> examineSmallTurns(double gyroscope_scale) {
  MotionExamination examination;
  for (int i = 0; i < 1500; ++i) examination.addGyroscope(kFirstSeen + i * kStep, gyroscope_scale * 0.08);
  std::vector<SeenMotion> seen;
  for (int second = 1; second < 29; ++second) {
    const StampNs from = kFirstSeen + second * StampNs{1'000'000'000};
    const double turn = 0.008 + 0.001 * (second % 3 - 1);
    seen.push_back({from, from + 100'000'000,
                    Pose(Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ())), Vector3d(0.1, 0.0, 0.0))});
  }
  return examination.findings(seen, "/wheels", "/imu", {});
}

TEST(MotionExamination, SmallTurnsShowRatesInDegrees) {
  EXPECT_TRUE(examineSmallTurns(1.0).empty());
  EXPECT_TRUE(examineSmallTurns(1.6).empty()) << "not certain by small turns";
  const std::vector<Finding> degrees = examineSmallTurns(180.0 / M_PI);
  ASSERT_EQ(degrees.size(), 1U);
  EXPECT_NE(degrees[0].text.find("deg/s"), std::string::npos) << degrees[0].text;
}

Vector3d tilted(double degrees) {
  return Eigen::AngleAxisd(degrees * M_PI / 180.0, Vector3d::UnitY()) * Vector3d::UnitZ();
}

TEST(MotionExamination, ContinuesFromItsState) {
  MotionExamination whole, first;
  for (int i = 0; i < 1500; ++i) {
    if (i == 700) {
      urban_nav_core::Archive writer;
      whole.archive(writer);
      const std::string bytes = writer.take();
      urban_nav_core::Archive reader(bytes, "state");
      first.archive(reader);
    }
    for (MotionExamination* each : {&whole, &first}) {
      if (each == &first && i < 700) continue;
      each->addWheels(kFirstSeen + i * kStep, {{50.0 + 0.024 * i, 0.0, 0.0}}, kSpeed);
      each->addGyroscope(kFirstSeen + i * kStep, 0.3);
    }
  }
  urban_nav_core::Archive of_whole, of_first;
  whole.archive(of_whole);
  first.archive(of_first);
  EXPECT_EQ(of_whole.take(), of_first.take());
}

TEST(GroundFindings, NameTheDeviceThatContradictsTheOtherTwo) {
  const std::vector<SeenGround> level(8, {tilted(1.0), 1.0}), inclined(8, {tilted(25.0), 1.0});
  EXPECT_TRUE(groundFindings("/imu", level, 9.8 * tilted(2.0)).empty());
  EXPECT_TRUE(groundFindings("/imu", level, 9.8 * tilted(-9.0)).empty()) << "a slope";
  EXPECT_TRUE(groundFindings("/imu", inclined, 9.8 * tilted(24.0)).empty()) << "base_link is inclined";
  EXPECT_TRUE(groundFindings("/imu", {{tilted(1.0), 1.0}}, 9.8 * tilted(30.0)).empty()) << "one pair is too few";
  const std::vector<Finding> imu = groundFindings("/imu", level, 9.8 * tilted(30.0));
  ASSERT_EQ(imu.size(), 1U);
  EXPECT_EQ(imu[0].kind, FindingKind::Imu);
  const std::vector<Finding> camera = groundFindings("/imu", inclined, 9.8 * tilted(2.0));
  ASSERT_EQ(camera.size(), 1U);
  EXPECT_EQ(camera[0].kind, FindingKind::Tf);
}

}  // namespace
}  // namespace urban_nav_input
