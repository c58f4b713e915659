// SPDX-License-Identifier: BSD-3-Clause
// Every fault of a serial device on a stepped clock: reported within a second, recovered within 2.5 s after its end (2
// s more for a boot), counted, and nothing old published.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "device/stepped_device.hpp"
#include "segway_drivers/driver/driver_options.hpp"
#include "urban_nav_sim/device/simulated_base.hpp"
#include "urban_nav_sim/device/simulated_gps.hpp"
#include "urban_nav_sim/device/simulated_imu.hpp"
#include "urban_nav_sim/device/simulated_laser.hpp"

namespace urban_nav {
namespace {

using segway_drivers::DeviceCounters;
using segway_drivers::DriverCore;
using segway_drivers::Parameters;
using segway_drivers::TimeNs;
using Counter = std::int64_t DeviceCounters::*;

constexpr double kSession = 30.0, kBegin = 8.0, kLength = 4.0;  // s

struct FaultRow {
  std::string fault;   ///< KIND, or KIND and :VALUE after its times
  Counter counter;     ///< that counts it
  std::string report;  ///< of the state; empty: the counter reports it
  double length = ::urban_nav::kLength;
  double boot = 0.0;  ///< s that the device takes after the fault's end
};

/// A device and its driver, with a callback for each message.
struct RowDevice {
  std::unique_ptr<urban_nav_sim::SimulatedDevice> device;
  std::unique_ptr<DriverCore> driver;
  int baud = 0;
};
using Taken = std::function<void(std::optional<TimeNs> stamp)>;
using Make = std::function<RowDevice(const urban_nav_sim::DeviceOptions&, const Taken&)>;

RowDevice makeLaser(const urban_nav_sim::DeviceOptions& options, const Taken& take) {
  std::vector<urban_nav_sim::LaserReading> readings;
  for (int i = 0; i * 0.0133381 < kSession; ++i)
    readings.push_back({i * 0.0133381, std::vector<float>(181, 2.0F), std::vector<float>(181, 9.0F)});
  RowDevice made{std::make_unique<urban_nav_sim::SimulatedLaser>(readings, options), nullptr};
  auto driver = std::make_unique<segway_drivers::LmsDriver>(segway_drivers::toLmsOptions(Parameters()));
  driver->on_scan = [take](const auto& scan) { take(scan.stamp); };
  made.driver = std::move(driver);
  return made;
}

RowDevice makeImu(const urban_nav_sim::DeviceOptions& options, const Taken& take) {
  std::vector<urban_nav_sim::ImuReading> readings(static_cast<std::size_t>(100.0 * kSession));
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i].time = 0.01 * static_cast<double>(i);
  RowDevice made{std::make_unique<urban_nav_sim::SimulatedImu>(readings, options), nullptr};
  auto driver = std::make_unique<segway_drivers::MtiDriver>(segway_drivers::toMtiOptions(Parameters()));
  driver->on_sample = [take](const auto& sample) { take(sample.stamp); };
  made.driver = std::move(driver);
  return made;
}

RowDevice makeBase(const urban_nav_sim::DeviceOptions& options, const Taken& take) {
  std::vector<urban_nav_sim::WheelReading> readings(static_cast<std::size_t>(100.0 * kSession));
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i] = {0.01 * static_cast<double>(i), 0.5, 0.0};
  RowDevice made{std::make_unique<urban_nav_sim::SimulatedBase>(readings, options), nullptr};
  auto driver = std::make_unique<segway_drivers::RmpDriver>(segway_drivers::toRmpOptions(Parameters()));
  driver->on_frame = [take](const auto& frame) { take(frame.stamp); };
  made.driver = std::move(driver);
  return made;
}

RowDevice makeGps(const urban_nav_sim::DeviceOptions& options, const Taken& take) {
  std::vector<urban_nav_sim::GpsReading> readings(static_cast<std::size_t>(kSession));
  for (std::size_t i = 0; i < readings.size(); ++i) {
    readings[i].time = static_cast<double>(i);
    readings[i].valid = true;
    readings[i].latitude = 51.75;
    readings[i].longitude = -1.25;
  }
  RowDevice made{std::make_unique<urban_nav_sim::SimulatedGps>(readings, 1.7e9, false, options), nullptr};
  auto driver = std::make_unique<segway_drivers::GpsDriver>(segway_drivers::toGpsOptions(Parameters(), "/dev/gps"));
  driver->on_fix = [take](const auto&, std::optional<TimeNs> stamp) { take(stamp); };
  made.driver = std::move(driver);
  return made;
}

/// `period`: s between messages; a slow device is reported after five periods at the earliest.
void expectRow(const Make& make, double period, const FaultRow& row) {
  urban_nav_sim::DeviceOptions options;
  const std::size_t value = row.fault.find(':');
  options.faults.push_back(urban_nav_sim::parseDeviceFault(
      row.fault.substr(0, value) + ":" + std::to_string(kBegin) + ":" + std::to_string(row.length) +
      (value == std::string::npos ? "" : row.fault.substr(value))));
  testing::SteppedDevice* clock = nullptr;
  double oldest = 0.0, returned = 0.0;
  const double end = kBegin + row.length;
  int messages = 0;
  const RowDevice made = make(options, [&](std::optional<TimeNs> stamp) {
    const double now = clock->seconds();
    ++messages;
    if (now > end && returned == 0.0) returned = now;
    if (stamp) oldest = std::max(oldest, now - 1e-9 * static_cast<double>(*stamp - testing::SteppedDevice::kBegin));
  });
  testing::SteppedDevice pair(*made.driver, *made.device, made.baud);
  clock = &pair;
  const double notice = std::max(1.0, 6.0 * period);
  pair.run(kBegin);
  EXPECT_GT(messages, static_cast<int>(2.0 / period)) << "before the fault";
  const std::int64_t before = made.driver->counters().*row.counter;
  pair.run(notice);
  const std::int64_t noticed = made.driver->counters().*row.counter;
  pair.run(kSession - 1.0 - pair.seconds());
  const std::int64_t after = made.driver->counters().*row.counter;
  EXPECT_GT(after, before) << "counted";
  if (row.report.empty()) {
    EXPECT_GT(noticed, before) << "reported by the counter";
  } else {
    const auto reported = pair.reportedAt(row.report, kBegin);
    ASSERT_TRUE(reported) << row.report;
    EXPECT_LT(*reported, kBegin + notice);
  }
  ASSERT_GT(returned, 0.0) << "recovered";
  EXPECT_LT(returned, end + 2.5 + row.boot + period);
  EXPECT_EQ(made.driver->state(), segway_drivers::DriverState::Streaming);
  EXPECT_LT(oldest, std::max(0.25, period)) << "age of a message at its publication";
}

void expectRows(const Make& make, double period, const std::vector<FaultRow>& rows) {
  for (const FaultRow& row : rows) {
    SCOPED_TRACE(row.fault);
    expectRow(make, period, row);
  }
}

TEST(FaultRows, Laser) {
  expectRows(makeLaser, 0.0133381,
             {{"flip:0.1", &DeviceCounters::bad_checksums, ""},
              {"garbage:40", &DeviceCounters::bytes_skipped, ""},
              {"cut:0.1", &DeviceCounters::bytes_skipped, ""},
              {"length", &DeviceCounters::bytes_skipped, ""},
              {"silence", &DeviceCounters::stalls, "stalled"},
              {"baud:9600", &DeviceCounters::stalls, "stalled"},
              {"unplug", &DeviceCounters::reconnections, "lost"},
              {"power:2", &DeviceCounters::stalls, "stalled", kLength, 2.0},
              {"gap:20", &DeviceCounters::gaps, ""}});
}

TEST(FaultRows, InertialUnit) {
  expectRows(makeImu, 0.01,
             {{"flip:0.1", &DeviceCounters::bad_checksums, ""},
              {"garbage:8", &DeviceCounters::bytes_skipped, ""},
              {"cut:0.1", &DeviceCounters::bytes_skipped, ""},
              {"length", &DeviceCounters::bytes_skipped, ""},
              {"silence", &DeviceCounters::stalls, "stalled"},
              {"unplug", &DeviceCounters::reconnections, "lost"},
              {"power:1", &DeviceCounters::stalls, "stalled", kLength, 2.0},
              {"gap", &DeviceCounters::gaps, "", 0.5}});
}

TEST(FaultRows, Base) {
  expectRows(makeBase, 0.01,
             {{"flip:0.1", &DeviceCounters::bad_checksums, ""},
              {"garbage:18", &DeviceCounters::bytes_skipped, ""},
              {"cut:0.1", &DeviceCounters::bytes_skipped, ""},
              {"silence", &DeviceCounters::stalls, "stalled"},
              {"unplug", &DeviceCounters::reconnections, "lost"},
              {"power:1", &DeviceCounters::stalls, "stalled", kLength, 2.0}});
}

TEST(FaultRows, Receiver) {
  expectRows(makeGps, 1.0,
             {{"flip:0.9", &DeviceCounters::bad_checksums, ""},
              {"garbage:30", &DeviceCounters::bytes_skipped, ""},
              {"silence", &DeviceCounters::stalls, "stalled", 8.0},
              {"unplug", &DeviceCounters::reconnections, "lost"}});
}

}  // namespace
}  // namespace urban_nav
