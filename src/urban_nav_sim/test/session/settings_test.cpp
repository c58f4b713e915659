// SPDX-License-Identifier: BSD-3-Clause
#include "session/settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

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
  EXPECT_EQ(lidarSettings(without("lidar3d:noise")).sigma, 0.0);
  EXPECT_GT(lidarSettings(without("lidar3d:noise")).ring_range_sigma, 0.0);
  EXPECT_EQ(lidarSettings(without("lidar3d:bias")).ring_angle_sigma, 0.0);
  EXPECT_FALSE(lidarSettings(without("lidar3d:edges")).mixes);
  EXPECT_TRUE(lidarSettings(without("lidar3d:edges")).loses);
  EXPECT_EQ(lidarSettings(without("lidar3d:steps")).step, 0.0);
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
  EXPECT_EQ(imuOptions(Defects()).rate_offset, 0.0);
  EXPECT_EQ(imuOptions(Defects()).scale_sigma, 0.0);
  EXPECT_FALSE(imuOptions(Defects()).mistakes.is_ned);
  EXPECT_NEAR(imuOptions(with("imu:offset")).rate_offset, 0.1 / std::sqrt(3.0), 1e-6);
  EXPECT_GT(imuOptions(with("imu:scale")).scale_sigma, 0.0);
  EXPECT_GT(imuOptions(with("imu:scale")).axes_sigma, 0.0);
  EXPECT_TRUE(imuOptions(with("imu:axes")).mistakes.exchanges_axes);
  EXPECT_TRUE(imuOptions(with("imu:degrees")).mistakes.uses_degrees);
  EXPECT_TRUE(imuOptions(with("imu:ned")).mistakes.is_ned);
  EXPECT_TRUE(imuOptions(with("imu:gravity")).mistakes.removes_gravity);
  EXPECT_EQ(wheelOptions(with("wheels:scale")).largest_scale, 0.03);
  EXPECT_FALSE(lidarSettings(with("lidar3d:times")).has_times);
  for (const Sensor sensor : {Sensor::Imu, Sensor::Wheels}) {
    const double delay = clockOptions(with(toString(sensor) + std::string(":delay")), sensor, 3).offset;
    EXPECT_GT(delay, 0.0);
    EXPECT_LE(delay, 0.05);
  }
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
