// SPDX-License-Identifier: BSD-3-Clause
#include "device_sessions.hpp"

#include <utility>
#include <vector>

#include "segway_drivers/driver/driver_options.hpp"
#include "urban_nav_sim/device/simulated_base.hpp"
#include "urban_nav_sim/device/simulated_gps.hpp"
#include "urban_nav_sim/device/simulated_imu.hpp"
#include "urban_nav_sim/device/simulated_laser.hpp"

namespace urban_nav::bench {

namespace {

urban_nav_sim::DeviceOptions sessionOptions() {
  urban_nav_sim::DeviceOptions options;
  options.delay = urban_nav_sim::DelayModel{urban_nav_sim::DelayModel::Kind::Exponential, 1.0, 1.0, 20.0};
  options.clock.skew = 50e-6;
  return options;
}

DeviceSession makeLaserSession(const std::string& name, double seconds) {
  constexpr double kPeriod = 0.0133381;  // s
  std::vector<urban_nav_sim::LaserReading> readings(static_cast<std::size_t>(seconds / kPeriod) + 1);
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] = {kPeriod * static_cast<double>(i),
                   std::vector<float>(181, 1.0F + 0.001F * static_cast<float>(i % 9000)),
                   std::vector<float>(181, static_cast<float>(i % 256))};
  DeviceSession made{name, std::make_unique<urban_nav_sim::SimulatedLaser>(std::move(readings), sessionOptions()),
                     nullptr};
  auto driver = std::make_unique<segway_drivers::LmsDriver>(segway_drivers::toLmsOptions(segway_drivers::Parameters()));
  driver->on_scan = [count = made.messages](const auto&) { ++*count; };
  made.driver = std::move(driver);
  return made;
}

DeviceSession makeImuSession(double seconds) {
  std::vector<urban_nav_sim::ImuReading> readings(static_cast<std::size_t>(100.0 * seconds));
  for (std::size_t i = 0; i < readings.size(); ++i) {
    readings[i].time = 0.01 * static_cast<double>(i);
    readings[i].acceleration = {0.0, 0.0, 9.81};
  }
  DeviceSession made{"xsens_mti", std::make_unique<urban_nav_sim::SimulatedImu>(std::move(readings), sessionOptions()),
                     nullptr};
  auto driver = std::make_unique<segway_drivers::MtiDriver>(segway_drivers::toMtiOptions(segway_drivers::Parameters()));
  driver->on_sample = [count = made.messages](const auto&) { ++*count; };
  made.driver = std::move(driver);
  return made;
}

DeviceSession makeBaseSession(double seconds) {
  std::vector<urban_nav_sim::WheelReading> readings(static_cast<std::size_t>(100.0 * seconds));
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i] = {0.01 * static_cast<double>(i), 0.5, 0.1};
  DeviceSession made{"segway_rmp",
                     std::make_unique<urban_nav_sim::SimulatedBase>(std::move(readings), sessionOptions()), nullptr};
  auto driver = std::make_unique<segway_drivers::RmpDriver>(segway_drivers::toRmpOptions(segway_drivers::Parameters()));
  driver->on_frame = [count = made.messages](const auto&) { ++*count; };
  made.driver = std::move(driver);
  return made;
}

DeviceSession makeGpsSession(double seconds) {
  std::vector<urban_nav_sim::GpsReading> readings(static_cast<std::size_t>(seconds));
  for (std::size_t i = 0; i < readings.size(); ++i) {
    readings[i].time = static_cast<double>(i);
    readings[i].valid = true;
    readings[i].latitude = 51.75;
    readings[i].longitude = -1.25;
  }
  DeviceSession made{"gps",
                     std::make_unique<urban_nav_sim::SimulatedGps>(std::move(readings), 1.7e9, false, sessionOptions()),
                     nullptr};
  auto driver = std::make_unique<segway_drivers::GpsDriver>(
      segway_drivers::toGpsOptions(segway_drivers::Parameters(), "/dev/gps"));
  driver->on_fix = [count = made.messages](const auto&, const auto&) { ++*count; };
  made.driver = std::move(driver);
  return made;
}

}  // namespace

void forEachSerialDevice(double seconds, const std::function<void(DeviceSession&)>& visit) {
  const std::vector<std::function<DeviceSession()>> makers = {
      [=] { return makeLaserSession("lms291, left", seconds); },
      [=] { return makeLaserSession("lms291, right", seconds); }, [=] { return makeImuSession(seconds); },
      [=] { return makeBaseSession(seconds); }, [=] { return makeGpsSession(seconds); }};
  for (const auto& make : makers) {
    DeviceSession session = make();
    visit(session);
  }
}

}  // namespace urban_nav::bench
