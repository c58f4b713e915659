// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "device/stepped_device.hpp"
#include "segway_drivers/driver/driver_options.hpp"
#include "urban_nav_sim/device/simulated_base.hpp"
#include "urban_nav_sim/device/simulated_gps.hpp"
#include "urban_nav_sim/device/simulated_imu.hpp"

namespace urban_nav {
namespace {

using segway_drivers::DriverState;

urban_nav_sim::DeviceOptions deviceOptions(const std::vector<std::string>& faults, double least_ms) {
  urban_nav_sim::DeviceOptions options;
  for (const std::string& fault : faults) options.faults.push_back(urban_nav_sim::parseDeviceFault(fault));
  options.delay = urban_nav_sim::DelayModel{urban_nav_sim::DelayModel::Kind::Exponential, least_ms, 1.0, 20.0};
  options.clock.skew = 50e-6;
  return options;
}

std::vector<urban_nav_sim::ImuReading> makeImuSession(double seconds) {
  std::vector<urban_nav_sim::ImuReading> readings(static_cast<std::size_t>(100.0 * seconds));
  for (std::size_t i = 0; i < readings.size(); ++i) {
    readings[i].time = 0.01 * static_cast<double>(i);
    readings[i].acceleration = {0.01 * static_cast<double>(i % 100), 0.0, 9.81};
    readings[i].rate = {0.0, 0.0, 0.25};
    readings[i].orientation = {std::cos(0.3), 0.0, 0.0, std::sin(0.3)};
  }
  return readings;
}

struct ImuOutcome {
  int samples = 0, late_samples = 0;
  double worst_ms = 0.0, worst_yaw = 0.0, worst_value = 0.0;
  segway_drivers::DeviceCounters counters;
  DriverState state = DriverState::Absent;
  std::string identity;
};

ImuOutcome runImu(double seconds, const std::vector<std::string>& faults) {
  urban_nav_sim::SimulatedImu device(makeImuSession(seconds + 1.0), deviceOptions(faults, 2.5));
  segway_drivers::MtiDriver driver(segway_drivers::toMtiOptions(segway_drivers::Parameters()));
  testing::SteppedDevice pair(driver, device);
  ImuOutcome outcome;
  driver.on_sample = [&](const segway_drivers::MtiStampedSample& sample) {
    ++outcome.samples;
    if (pair.seconds() > seconds - 1.0) ++outcome.late_samples;
    outcome.worst_value = std::max(outcome.worst_value, std::abs((*sample.sample.acceleration)[2] - 9.81));
    const auto q = segway_drivers::mtiOrientationEnu(sample.sample);
    outcome.worst_yaw = std::max(outcome.worst_yaw, std::abs(2.0 * std::atan2((*q)[3], (*q)[0]) - 0.6));
    if (!sample.stamp || pair.seconds() < 5.0) return;
    // Samples are 10 ms apart, so that the nearest is the right one where the error is small.
    const double t = 1e-9 * static_cast<double>(*sample.stamp - testing::SteppedDevice::kBegin) * (1.0 + 50e-6);
    outcome.worst_ms = std::max(outcome.worst_ms, 1e3 * std::abs(std::remainder(t, 0.01)));
  };
  pair.run(seconds);
  outcome.counters = driver.counters();
  outcome.state = driver.state();
  outcome.identity = driver.identity();
  return outcome;
}

void expectSound(const ImuOutcome& outcome) {
  EXPECT_EQ(outcome.state, DriverState::Streaming);
  EXPECT_GT(outcome.late_samples, 95);
  EXPECT_LT(outcome.worst_ms, 1.0);
  EXPECT_LT(outcome.worst_yaw, 1e-5);
  EXPECT_LT(outcome.worst_value, 1e-5);
}

TEST(ImuFaults, ADeviceInMeasurementIsConfiguredAndStreams) {
  const ImuOutcome outcome = runImu(20.0, {});
  expectSound(outcome);
  EXPECT_NE(outcome.identity.find("MTi-28A53G35"), std::string::npos) << outcome.identity;
  EXPECT_EQ(outcome.counters.bad_checksums, 0);
  EXPECT_LT(outcome.counters.gaps, 10);  // of the pause for configuration
}

// Garbage occupies the line: 8 bytes delay a message by 0.7 ms.
TEST(ImuFaults, EachFaultIsSurvived) {
  for (const char* const fault : {"flip:6:8:0.05", "cut:6:8:0.05", "garbage:6:8:8", "length:6:8", "silence:6:3",
                                  "unplug:6:3", "power:6:2:1", "late:0:3:150", "mode:0:1", "gap:8:1", "delay:10:4"}) {
    SCOPED_TRACE(fault);
    expectSound(runImu(20.0, {fault}));
  }
}

TEST(ImuFaults, AnHourKeepsItsStamps) {
  const ImuOutcome outcome = runImu(3600.0, {});
  expectSound(outcome);
  EXPECT_EQ(outcome.counters.epochs, 0);
  EXPECT_GT(outcome.samples, 359000);
}

/// A base that turns at 0.1 rad/s while it drives 0.5 m/s, and a driver that is asked for 0.3 m/s.
TEST(BaseFaults, OdometryIsContinuousAcrossAPowerCycleAndCommandsRestFirst) {
  std::vector<urban_nav_sim::WheelReading> readings(2600);
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i] = {0.01 * static_cast<double>(i), 0.5, 0.0};
  urban_nav_sim::SimulatedBase device(readings, deviceOptions({"power:8:2:1", "unplug:16:1"}, 0.0));
  segway_drivers::RmpDriver driver(segway_drivers::toRmpOptions(segway_drivers::Parameters()));
  testing::SteppedDevice pair(driver, device);
  double last_x = 0.0, largest_step = 0.0;
  std::vector<std::pair<double, double>> in_force;  // s, m/s, as the base says
  driver.on_frame = [&](const segway_drivers::RmpStampedFrame& frame) {
    if (frame.frame.id == 0x404) largest_step = std::max(largest_step, std::abs(driver.odometry().x() - last_x));
    last_x = driver.odometry().x();
    if (frame.frame.id == 0x407)
      in_force.emplace_back(pair.seconds(), *(*segway_drivers::decodeRmpValues(frame.frame))[0]);
  };
  while (pair.seconds() < 22.0) {
    driver.guard().setWish({0.3, 0.0}, pair.now());
    pair.run(0.05);
  }
  EXPECT_EQ(driver.state(), DriverState::Streaming);
  EXPECT_LT(largest_step, 0.05);
  EXPECT_GT(last_x, 0.5 * 12.0);
  EXPECT_EQ(driver.odometry().jumps(), 0);
  EXPECT_EQ(driver.counters().reconnections, 1);
  double returned = 0.0;
  for (std::size_t i = 1; i < in_force.size(); ++i) {
    const auto& [t, velocity] = in_force[i];
    EXPECT_LE(velocity, 0.302);
    if (t < 0.5) {
      EXPECT_EQ(velocity, 0.0) << t;
    }
    if (t - in_force[i - 1].first > 0.5) returned = t;
    if (returned > 0.0 && t - returned < 0.45 && t - returned > 0.1) {
      EXPECT_EQ(velocity, 0.0) << t;
    }
  }
  EXPECT_GT(in_force.back().second, 0.29);
}

TEST(GpsFaults, FixesOfAReceiverAndOfGpsdAgree) {
  std::vector<urban_nav_sim::GpsReading> readings(30);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    readings[i].time = static_cast<double>(i);
    readings[i].valid = i > 5;
    readings[i].latitude = 51.75 + 1e-5 * static_cast<double>(i);
    readings[i].longitude = -1.25;
    readings[i].height = 110.0;
    readings[i].speed = 1.5;
    readings[i].track = 40.0;
  }
  std::vector<std::vector<segway_drivers::GpsFix>> fixes(2);
  for (const bool gpsd : {false, true}) {
    urban_nav_sim::SimulatedGps device(readings, 1.7e9, gpsd, urban_nav_sim::DeviceOptions());
    segway_drivers::GpsDriver driver(
        segway_drivers::toGpsOptions(segway_drivers::Parameters(), gpsd ? "localhost:2947" : "/dev/gps"));
    testing::SteppedDevice pair(driver, device, gpsd ? 100'000'000 : 0);
    driver.on_fix = [&](const segway_drivers::GpsFix& fix, std::optional<segway_drivers::TimeNs> stamp) {
      EXPECT_TRUE(stamp);
      fixes[gpsd ? 1 : 0].push_back(fix);
    };
    pair.run(28.0);
    EXPECT_EQ(driver.state(), DriverState::Streaming);
  }
  ASSERT_GT(fixes[0].size(), 24U);
  std::size_t compared = 0;
  for (const segway_drivers::GpsFix& a : fixes[0]) {
    for (const segway_drivers::GpsFix& b : fixes[1]) {
      if (a.utc != b.utc) continue;
      ++compared;
      EXPECT_EQ(a.latitude.has_value(), b.latitude.has_value()) << a.utc;
      if (!a.latitude || !b.latitude) continue;
      EXPECT_NEAR(*a.latitude, *b.latitude, 1e-6);
      EXPECT_NEAR(*a.height, *b.height, 0.1);
      EXPECT_NEAR(*a.speed, *b.speed, 0.01);
    }
  }
  EXPECT_GT(compared, 20U);
}

}  // namespace
}  // namespace urban_nav
