// SPDX-License-Identifier: BSD-3-Clause
#include "session/settings.hpp"

#include <gtest/gtest.h>

namespace urban_nav_sim {
namespace {

Defects without(const std::string& word) {
  Defects defects;
  defects.switchOff(word);
  return defects;
}

Defects with(const std::string& word) {
  Defects defects;
  defects.switchOn(word);
  return defects;
}

TEST(Settings, UsualDefectsAreTheDevicesOwn) {
  const Defects usual;
  EXPECT_EQ(stereoImages(usual), StereoImages::Rectified);
  EXPECT_TRUE(cameraDefects(usual, Sensor::Stereo).is_noisy);
  EXPECT_TRUE(cameraDefects(usual, Sensor::Ladybug).adapts);
  const Lms291::Settings lasers = laserSettings(usual), its_own;
  EXPECT_EQ(lasers.sigma, its_own.sigma);
  EXPECT_EQ(lasers.largest_bias, its_own.largest_bias);
  EXPECT_EQ(lasers.step, its_own.step);
  EXPECT_EQ(lasers.systematic_error, 0.0);
  EXPECT_EQ(imuOptions(usual).rate_density, ImuOptions().rate_density);
  EXPECT_EQ(imuOptions(usual).force_bias_time, ImuOptions().force_bias_time);
  EXPECT_EQ(imuOptions(usual).field_disturbance, ImuOptions().field_disturbance);
  EXPECT_EQ(wheelOptions(usual).track, WheelOptions().track);
  EXPECT_TRUE(wheelOptions(usual).counts);
  EXPECT_EQ(gpsOptions(usual).velocity_sigma, GpsOptions().velocity_sigma);
  EXPECT_TRUE(gpsOptions(usual).gaps);
}

TEST(Settings, ADefectThatIsOffLeavesTheOthers) {
  EXPECT_FALSE(cameraDefects(without("stereo:blur"), Sensor::Stereo).blurs);
  EXPECT_TRUE(cameraDefects(without("stereo:blur"), Sensor::Stereo).is_noisy);
  EXPECT_TRUE(cameraDefects(without("stereo:blur"), Sensor::Ladybug).blurs);
  EXPECT_EQ(laserSettings(without("lasers:noise")).sigma, 0.0);
  EXPECT_GT(laserSettings(without("lasers:noise")).largest_bias, 0.0);
  EXPECT_FALSE(laserSettings(without("lasers:edges")).mixes);
  EXPECT_TRUE(laserSettings(without("lasers:edges")).loses);
  EXPECT_EQ(imuOptions(without("imu:bias")).rate_walk, 0.0);
  EXPECT_GT(imuOptions(without("imu:bias")).rate_density, 0.0);
  EXPECT_EQ(wheelOptions(without("wheels:tyres")).track, 1.0);
  EXPECT_GT(wheelOptions(without("wheels:tyres")).slip_sigma, 0.0);
  EXPECT_EQ(gpsOptions(without("gps:multipath")).multipath_sigma, 0.0);
  EXPECT_TRUE(gpsOptions(without("gps:multipath")).gaps);
}

TEST(Settings, WhatIsUnusualIsSwitchedOn) {
  EXPECT_EQ(stereoImages(with("stereo:lens")), StereoImages::Raw);
  EXPECT_EQ(laserSettings(with("lasers:offset")).systematic_error, 0.035);
  const ClockOptions usual = clockOptions(Defects(), Sensor::Imu, 3),
                     own = clockOptions(with("imu:clock"), Sensor::Imu, 3);
  EXPECT_EQ(usual.offset, 0.0);
  EXPECT_GT(usual.jitter, 0.0);
  EXPECT_NE(own.offset, 0.0);
  EXPECT_NE(own.skew, 0.0);
  EXPECT_EQ(clockOptions(with("imu:clock"), Sensor::Gps, 3).offset, 0.0);
  Defects neither = with("imu:clock");
  neither.switchOff("imu:jitter");
  EXPECT_EQ(clockOptions(neither, Sensor::Imu, 3).jitter, 0.0);
  EXPECT_EQ(clockOptions(neither, Sensor::Imu, 3).offset, own.offset);
}

}  // namespace
}  // namespace urban_nav_sim
