// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/sensor_inputs.hpp"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <cmath>

#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/accelerometer.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_ros {
namespace {

constexpr std::int64_t kStamp = 20'000'000'000;

SensorInputs withSettings(const std::vector<CorrectionSetting>& settings) {
  LiveCorrectionParameters parameters;
  for (const CorrectionSetting& setting : settings) {
    const auto& rows = liveCorrectionTable().rows();
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const auto& each) { return each.name == setting.name; });
    if (row == rows.end()) throw std::out_of_range(setting.name);
    if (row->type == urban_nav_core::ParameterType::Word)
      liveCorrectionTable().set(parameters, row->name, setting.value);
    else liveCorrectionTable().set(parameters, row->name, std::stod(setting.value));
  }
  return SensorInputs(toCorrections(parameters));
}

/// Half a revolution at 5 to 8 m, with ranges multiplied by `unit`.
sensor_msgs::LaserScanConstPtr scan(float unit) {
  const auto message = boost::make_shared<sensor_msgs::LaserScan>();
  message->header.stamp = toRosTime(kStamp);
  message->header.frame_id = "laser_left";
  message->angle_min = -1.5707964F;
  message->angle_max = 1.5707964F;
  message->angle_increment = 0.017453292F;
  message->range_min = 0.1F * unit;
  message->range_max = 80.0F * unit;
  message->time_increment = 1e-4F;
  for (int i = 0; i < 181; ++i)
    message->ranges.push_back(unit * (5.0F + 3.0F * std::sin(0.1F * static_cast<float>(i))));
  return message;
}

TEST(SensorInputs, WithoutParametersMessagesArePassedOn) {
  const SensorInputs inputs;
  const sensor_msgs::LaserScanConstPtr laser = scan(1.0F);
  const auto imu = boost::make_shared<const sensor_msgs::Imu>();
  EXPECT_EQ(inputs.correct(topics::kLaserLeft, laser), laser);
  EXPECT_EQ(inputs.correct(topics::kImu, imu), imu);
  EXPECT_TRUE(inputs.faults().empty());
}

TEST(SensorInputs, TheParameterThatAFaultNamesRepairsTheLaser) {
  const SensorInputs before;
  before.correct(topics::kLaserLeft, scan(1000.0F));
  ASSERT_EQ(before.faults().size(), 1U);
  EXPECT_NE(before.faults()[0].find("laser_left/scan is not used: the median range is"), std::string::npos);
  EXPECT_NE(before.faults()[0].find("millimetres; repair the driver, or set input/laser_left_range_scale to 0.001"),
            std::string::npos)
      << before.faults()[0];

  const SensorInputs after = withSettings({{"laser_left_range_scale", "0.001"}});
  const auto repaired = toPlanarScan(*after.correct(topics::kLaserLeft, scan(1000.0F)));
  const auto sound = toPlanarScan(*scan(1.0F));
  EXPECT_TRUE(after.faults().empty());
  ASSERT_TRUE(repaired && sound);
  ASSERT_EQ(repaired->ranges.size(), sound->ranges.size());
  for (std::size_t i = 0; i < sound->ranges.size(); ++i) EXPECT_NEAR(repaired->ranges[i], sound->ranges[i], 1e-5);
  EXPECT_NEAR(repaired->range_max, 80.0, 1e-3);
  EXPECT_NEAR(repaired->time_step, sound->time_step, 1e-9);
  // The other laser has its own parameters.
  EXPECT_EQ(after.correct(topics::kLaserRight, scan(1000.0F))->ranges[0], scan(1000.0F)->ranges[0]);
  EXPECT_EQ(after.faults().size(), 1U);
}

TEST(SensorInputs, AFaultIsOverWithTheFirstSoundScan) {
  const SensorInputs inputs;
  inputs.correct(topics::kLaserRight, scan(100.0F));
  EXPECT_EQ(inputs.faults().size(), 1U);
  inputs.correct(topics::kLaserRight, scan(1.0F));
  EXPECT_TRUE(inputs.faults().empty());
}

TEST(SensorInputs, DelaysAndScalesApplyToTheTopicOfTheirSensorAlone) {
  const SensorInputs inputs = withSettings({{"imu_delay", "2000"},
                                            {"gyroscope_scale", "0.5"},
                                            {"wheels_delay", "-5000"},
                                            {"wheels_scale", "-1"},
                                            {"gps_delay", "18000"},
                                            {"laser_right_delay", "3000"},
                                            {"laser0_delay", "4000"}});
  const auto imu = boost::make_shared<sensor_msgs::Imu>();
  imu->header.stamp = toRosTime(kStamp);
  imu->angular_velocity.z = 0.2;
  const auto corrected = inputs.correct(topics::kImu, sensor_msgs::ImuConstPtr(imu));
  EXPECT_EQ(toStampNs(corrected->header.stamp), kStamp - 2'000'000'000);
  EXPECT_DOUBLE_EQ(corrected->angular_velocity.z, 0.1);
  EXPECT_DOUBLE_EQ(imu->angular_velocity.z, 0.2);  // the message is shared with other subscribers of the process

  const auto odometry = boost::make_shared<nav_msgs::Odometry>();
  odometry->header.stamp = toRosTime(kStamp);
  odometry->pose.pose.position.x = 3.0;
  const nav_msgs::OdometryConstPtr wheels = odometry;
  EXPECT_DOUBLE_EQ(inputs.correct(topics::kWheelOdometry, wheels)->pose.pose.position.x, -3.0);
  EXPECT_EQ(toStampNs(inputs.correct(topics::kWheelOdometry, wheels)->header.stamp), kStamp + 5'000'000'000);
  EXPECT_EQ(inputs.correct(topics::kVoOdometry, wheels), wheels);

  const auto fix = boost::make_shared<sensor_msgs::NavSatFix>();
  fix->header.stamp = toRosTime(kStamp);
  EXPECT_EQ(toStampNs(inputs.correct(topics::kGpsFix, sensor_msgs::NavSatFixConstPtr(fix))->header.stamp),
            kStamp - 18'000'000'000);
  EXPECT_EQ(toStampNs(inputs.correct(topics::kLaserRight, scan(1.0F))->header.stamp), kStamp - 3'000'000'000);
  EXPECT_EQ(toStampNs(inputs.correct(topics::kScan, scan(1.0F))->header.stamp), kStamp - 4'000'000'000);
  EXPECT_EQ(toStampNs(inputs.correct(topics::kLaserLeft, scan(1.0F))->header.stamp), kStamp);
}

TEST(SensorInputs, AStampThatIsNotAboveTheDelayMakesNoMessage) {
  const SensorInputs inputs = withSettings({{"imu_delay", "30000"}, {"laser_left_delay", "30000"}});
  const auto imu = boost::make_shared<sensor_msgs::Imu>();
  imu->header.stamp = toRosTime(kStamp);
  EXPECT_FALSE(inputs.correct(topics::kImu, sensor_msgs::ImuConstPtr(imu)));
  EXPECT_FALSE(inputs.correct(topics::kLaserLeft, scan(1.0F)));
}

TEST(SensorInputs, WhatTheAccelerometerNamesRepairsIt) {
  const auto withConvention = [](const urban_nav_core::AccelerometerConvention& convention) {
    Accelerometer accelerometer(urban_nav_core::Matrix3d::Identity(), convention);
    sensor_msgs::Imu imu;
    imu.linear_acceleration.z = -1.0;  // g, with the sign of NED
    for (int i = 1; i < 500; ++i) {
      imu.header.stamp = toRosTime(std::int64_t{10'000'000} * i);
      accelerometer.add(imu);
    }
    return accelerometer.verdict();
  };
  const std::vector<CorrectionSetting> settings = settingsFor(withConvention({}), {});
  ASSERT_EQ(settings.size(), 2U);
  EXPECT_EQ(settings[0].name, "accelerometer_axes");
  EXPECT_TRUE(withConvention(withSettings(settings).corrections().accelerometer).sound());
}

TEST(SensorInputs, RefusesWhatLeavesNoMeasurement) {
  EXPECT_THROW(withSettings({{"accelerometer_axes", "x,x,z"}}), urban_nav_core::UserError);
  EXPECT_THROW(withSettings({{"wheels_scale", "0"}}), urban_nav_core::UserError);
}

}  // namespace
}  // namespace urban_nav_ros
