// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "device/stepped_device.hpp"
#include "segway_drivers/lms291/driver.hpp"
#include "urban_nav_sim/device/simulated_laser.hpp"

namespace urban_nav {
namespace {

using segway_drivers::DriverState;
using segway_drivers::LmsStampedScan;

constexpr double kLaserPeriod = 0.0133381;

std::vector<urban_nav_sim::LaserReading> makeLaserSession(double seconds) {
  std::vector<urban_nav_sim::LaserReading> readings;
  for (int i = 0; i * kLaserPeriod < seconds; ++i) {
    urban_nav_sim::LaserReading reading;
    reading.time = i * kLaserPeriod;
    for (int beam = 0; beam < 181; ++beam) {
      reading.ranges.push_back(beam == 7 ? INFINITY : static_cast<float>(0.001 * (1000 + (i * 37 + beam) % 20000)));
      reading.reflectivities.push_back(static_cast<float>((i + beam) % 256));
    }
    readings.push_back(std::move(reading));
  }
  return readings;
}

/// Outcome of a session with one fault.
struct LaserOutcome {
  std::vector<std::pair<double, LmsStampedScan>> scans;  // arrival, s since the begin
  segway_drivers::DeviceCounters counters;
  DriverState state = DriverState::Absent;
  int wrong_values = 0;
  double worst_ms = 0.0;  // error of the stamps from 5 s on
  bool rises = true;
  bool stalled = false, lost = false;
  std::string texts;

  int countBetween(double from, double to) const {
    int count = 0;
    for (const auto& [time, scan] : scans) count += time >= from && time < to ? 1 : 0;
    return count;
  }
};

LaserOutcome runLaser(double seconds, const std::vector<std::string>& faults, bool configure = false) {
  urban_nav_sim::DeviceOptions options;
  for (const std::string& fault : faults) options.faults.push_back(urban_nav_sim::parseDeviceFault(fault));
  options.delay = urban_nav_sim::DelayModel::parse("exponential:1:1:20", 1.0);
  const auto session = makeLaserSession(seconds + 1.0);
  urban_nav_sim::SimulatedLaser laser(session, options);
  segway_drivers::LmsDriver::Options driver_options;
  driver_options.stream.latency = 0.001;
  driver_options.configure = configure;
  segway_drivers::LmsDriver driver(driver_options);
  LaserOutcome outcome;
  testing::SteppedDevice pair(driver, laser);
  driver.on_scan = [&](const LmsStampedScan& scan) { outcome.scans.emplace_back(pair.seconds(), scan); };
  pair.run(seconds);

  // Scans are distinguished by their values; the truth gives the time of each.
  std::map<std::vector<float>, std::int64_t> times;
  for (const auto& each : pair.truth())
    times[std::vector<float>(session[static_cast<std::size_t>(each.sequence)].ranges.begin() + 8,
                             session[static_cast<std::size_t>(each.sequence)].ranges.begin() + 12)] = each.time;
  std::int64_t last = 0;
  int last_epoch = 0;
  for (const auto& [time, scan] : outcome.scans) {
    const auto found = times.find(std::vector<float>(scan.scan.ranges.begin() + 8, scan.scan.ranges.begin() + 12));
    if (found == times.end() || !std::isinf(scan.scan.ranges[7])) ++outcome.wrong_values;
    if (!scan.stamp || found == times.end()) continue;
    if (time > 5.0)
      outcome.worst_ms = std::max(outcome.worst_ms, 1e-6 * std::abs(static_cast<double>(*scan.stamp - found->second)));
    if (*scan.stamp <= last && scan.epoch == last_epoch) outcome.rises = false;
    last = *scan.stamp;
    last_epoch = scan.epoch;
  }
  outcome.counters = driver.counters();
  outcome.state = driver.state();
  outcome.stalled = pair.reported("stalled");
  outcome.lost = pair.reported("lost");
  for (const auto& event : pair.events()) outcome.texts += event.text + "\n";
  return outcome;
}

void expectSound(const LaserOutcome& outcome, double worst_ms = 1.0) {
  EXPECT_EQ(outcome.wrong_values, 0);
  EXPECT_TRUE(outcome.rises);
  EXPECT_LT(outcome.worst_ms, worst_ms);
  EXPECT_EQ(outcome.state, DriverState::Streaming) << outcome.texts;
}

TEST(LaserFaults, NoneWhereThereIsNone) {
  const LaserOutcome outcome = runLaser(20.0, {});
  expectSound(outcome, 0.5);
  EXPECT_GT(outcome.countBetween(3.0, 20.0), 1270);
  EXPECT_EQ(outcome.counters.gaps, 0);
  EXPECT_EQ(outcome.counters.bad_checksums, 0);
  EXPECT_EQ(outcome.counters.reconnections, 0);
  EXPECT_EQ(outcome.counters.epochs, 0);
}

TEST(LaserFaults, DamagedFramesAreDroppedOneByOne) {
  for (const char* const fault : {"flip:6:10:0.05", "cut:6:10:0.05", "garbage:6:10:40", "length:6:10"}) {
    const LaserOutcome outcome = runLaser(20.0, {fault});
    expectSound(outcome);
    EXPECT_GT(outcome.counters.bytes_skipped, 0) << fault;
    EXPECT_GT(outcome.countBetween(6.0, 16.0), 600) << fault;
    EXPECT_GT(outcome.countBetween(17.0, 20.0), 220) << fault;
  }
}

TEST(LaserFaults, ASilenceIsReportedAndNothingOldIsRepublished) {
  const LaserOutcome outcome = runLaser(20.0, {"silence:8:4"});
  expectSound(outcome);
  EXPECT_TRUE(outcome.stalled);
  EXPECT_EQ(outcome.countBetween(8.1, 12.0), 0);
  EXPECT_GT(outcome.countBetween(12.5, 13.5), 60);
}

TEST(LaserFaults, AnUnpluggedCableIsOneReconnection) {
  const LaserOutcome outcome = runLaser(20.0, {"unplug:8:3"});
  expectSound(outcome);
  EXPECT_TRUE(outcome.lost);
  EXPECT_EQ(outcome.counters.reconnections, 1);
  EXPECT_GT(outcome.countBetween(11.5, 12.5), 60);
}

TEST(LaserFaults, APowerCycleNeedsNoRestartOfTheDriver) {
  const LaserOutcome outcome = runLaser(25.0, {"power:8:3:2"});
  expectSound(outcome);
  EXPECT_TRUE(outcome.stalled);
  EXPECT_GT(outcome.countBetween(16.0, 17.0), 60) << outcome.texts;
}

TEST(LaserFaults, ADeviceThatStreamsIsNotInterrupted) {
  const LaserOutcome outcome = runLaser(10.0, {"streaming:0:10"});
  expectSound(outcome);
  EXPECT_GT(outcome.countBetween(0.0, 1.0), 60);
}

TEST(LaserFaults, RefusedAndLateRepliesAreSurvived) {
  for (const char* const fault : {"nak:0:2", "late:0:2:150"}) {
    const LaserOutcome outcome = runLaser(20.0, {fault});
    expectSound(outcome);
    EXPECT_GT(outcome.countBetween(7.0, 8.0), 60) << fault << "\n" << outcome.texts;
  }
}

TEST(LaserFaults, AnUnsuitableModeIsRefusedOrRewritten) {
  const LaserOutcome refused = runLaser(10.0, {"mode:0:1"});
  EXPECT_TRUE(refused.scans.empty());
  EXPECT_NE(refused.texts.find("lms291.configure"), std::string::npos) << refused.texts;
  expectSound(runLaser(10.0, {"mode:0:1"}, true));
}

TEST(LaserFaults, GapsOfAnySizeKeepTheStamps) {
  for (const int gap : {1, 255, 256, 257}) {
    const LaserOutcome outcome = runLaser(20.0, {"gap:9:1:" + std::to_string(gap)});
    expectSound(outcome);
    EXPECT_EQ(outcome.counters.gaps, gap);
  }
}

TEST(LaserFaults, ACounterThatBeginsAgainIsAnEpochOrRight) {
  const LaserOutcome outcome = runLaser(20.0, {"clock:9:1"});
  expectSound(outcome, 3.0);
}

TEST(LaserFaults, ALongerLeastDelayForAWhileDoesNotMoveTheStamps) {
  const LaserOutcome outcome = runLaser(60.0, {"delay:40:10:5"});
  expectSound(outcome);
}

}  // namespace
}  // namespace urban_nav
