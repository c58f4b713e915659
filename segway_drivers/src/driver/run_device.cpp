// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/driver/run_device.hpp"

#include <cmath>

#include "segway_drivers/gps/driver.hpp"
#include "segway_drivers/lms291/driver.hpp"
#include "segway_drivers/segway_rmp/driver.hpp"
#include "segway_drivers/table/row_decoder.hpp"
#include "segway_drivers/xsens_mti/driver.hpp"
#include "table/rows.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

using urban_nav_core::UserError;

namespace {

constexpr TimeNs run_wait = 2'000'000;    // ns
constexpr TimeNs clock_step = 1'000'000;  // ns, of the host clock that is worth a warning

/// Writes stamped messages in real time.
class RunTable {
 public:
  RunTable(const std::string& path, const std::string& kind) : file_(path), offset_(realTimeOffset()) {
    file_.write("frame,offset,stamp_ns," + rowColumns(kind) + "\n");
  }
  /// `stamp`: steady time.
  void add(std::optional<TimeNs> stamp, const std::string& cells) {
    if (!stamp) return;
    file_.write(std::to_string(frame_++) + ",," + std::to_string(*stamp + offset_) + "," + cells + "\n");
  }
  /// Follows the host clock. Returns the size of a step, ns; 0 if there was none.
  TimeNs followHostClock() {
    const TimeNs offset = realTimeOffset(), step = offset - offset_;
    if (std::abs(step) < clock_step) {
      offset_ += step / 16;  // of the readings, and of a clock that is slewed
      return 0;
    }
    offset_ = offset;
    return step;
  }
  void commit() { file_.commit(); }

 private:
  urban_nav_core::AtomicFile file_;
  TimeNs offset_;
  std::int64_t frame_ = 0;
};

std::unique_ptr<DriverCore> makeLmsDriver(const Parameters& parameters, RunTable& table) {
  LmsDriver::Options options;
  options.stream.latency = 1e-3 * parameters.lms291_latency_ms;
  const auto mode = static_cast<std::uint8_t>(parameters.lms291_measuring_mode);
  if (const auto format = LmsRangeFormat::fromConfiguration(mode, 1)) options.stream.format = *format;
  options.configure = parameters.lms291_configure;
  auto driver = std::make_unique<LmsDriver>(options);
  driver->on_scan = [&table](const LmsStampedScan& scan) { table.add(scan.stamp, lmsCells(scan.scan)); };
  return driver;
}

std::unique_ptr<DriverCore> makeMtiDriver(const Parameters& parameters, RunTable& table) {
  MtiDriver::Options options;
  options.rate = parameters.xsens_mti_rate;
  options.stream.mode = static_cast<unsigned>(parameters.xsens_mti_mode);
  options.stream.settings = static_cast<unsigned>(parameters.xsens_mti_settings);
  options.stream.period = 1.0 / parameters.xsens_mti_rate;
  options.stream.latency = 1e-3 * parameters.xsens_mti_latency_ms;
  auto driver = std::make_unique<MtiDriver>(options);
  driver->on_sample = [&table](const MtiStampedSample& sample) { table.add(sample.stamp, mtiCells(sample.sample)); };
  return driver;
}

std::unique_ptr<RmpDriver> makeRmpDriver(const Parameters& parameters, RunTable& table) {
  RmpDriver::Options options;
  options.latency = 1e-3 * parameters.segway_rmp_latency_ms;
  options.limits.velocity = parameters.segway_rmp_max_velocity;
  options.limits.turn_rate = parameters.segway_rmp_max_turn_rate;
  options.limits.acceleration = parameters.segway_rmp_acceleration;
  options.limits.angular_acceleration = parameters.segway_rmp_angular_acceleration;
  options.limits.timeout = parameters.segway_rmp_command_timeout;
  auto driver = std::make_unique<RmpDriver>(options);
  driver->on_frame = [&table](const RmpStampedFrame& frame) { table.add(frame.stamp, rmpCells(frame.frame)); };
  return driver;
}

std::unique_ptr<DriverCore> makeGpsDriver(const Parameters& parameters, RunTable& table, bool gpsd) {
  GpsDriver::Options options;
  options.stream.uere = parameters.gps_uere;
  options.stream.latency = 1e-3 * parameters.gps_latency_ms;
  options.gpsd = gpsd;
  auto driver = std::make_unique<GpsDriver>(options);
  driver->on_fix = [&table](const GpsFix& fix, std::optional<TimeNs> stamp) { table.add(stamp, gpsCells(fix)); };
  return driver;
}

}  // namespace

std::vector<DriveWish> readDriveFile(const std::string& path) {
  const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::read(path);
  const std::size_t time = table.column("t_s"), linear = table.column("linear_mps"),
                    angular = table.column("angular_radps");
  std::vector<DriveWish> wishes;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t = table.number(row, time);
    if (t < 0.0 || t > 1e6 || (!wishes.empty() && 1e9 * t < static_cast<double>(wishes.back().time)))
      throw UserError(table.where(row), "t_s = " + table.text(row, time), "0...1000000 s, not falling");
    wishes.push_back(
        {static_cast<TimeNs>(std::llround(1e9 * t)), {table.number(row, linear), table.number(row, angular)}});
  }
  return wishes;
}

RunResult runDevice(const RunJob& job, const Parameters& parameters,
                    const std::function<void(const DriverEvent&)>& report) {
  const std::vector<DriveWish> wishes = job.drive.empty() ? std::vector<DriveWish>() : readDriveFile(job.drive);
  RunTable table(job.output, job.kind);
  std::unique_ptr<DriverCore> core;
  RmpDriver* base = nullptr;
  if (job.kind == "lms291") core = makeLmsDriver(parameters, table);
  else if (job.kind == "xsens_mti") core = makeMtiDriver(parameters, table);
  else if (job.kind == "gps")
    core = makeGpsDriver(parameters, table,
                         job.port.find('/') == std::string::npos && job.port.find(':') != std::string::npos);
  else if (job.kind == "segway_rmp") {
    auto driver = makeRmpDriver(parameters, table);
    base = driver.get();
    core = std::move(driver);
  } else throw UserError("KIND", job.kind + " does not run", "lms291, xsens_mti, segway_rmp, gps");
  if (base == nullptr && !wishes.empty()) throw UserError("--drive", job.kind, "segway_rmp");

  DriverLoop loop(*core, job.port);
  loop.open();
  if (!loop.remark().empty()) report({true, job.port + ": " + loop.remark()});
  const TimeNs begin = steadyTime(), end = begin + static_cast<TimeNs>(std::llround(1e9 * job.duration));
  std::size_t next_wish = 0;
  for (TimeNs now = begin; now < end; now = steadyTime()) {
    for (; base != nullptr && next_wish < wishes.size() && wishes[next_wish].time <= now - begin; ++next_wish)
      base->guard().setWish(wishes[next_wish].wish, now);
    loop.step(std::min(run_wait, end - now));
    if (const TimeNs step = table.followHostClock(); step != 0)
      report({true, "host clock stepped by " + std::to_string(step / 1'000'000) + " ms"});
    for (const DriverEvent& event : core->takeEvents()) report(event);
  }
  table.commit();
  RunResult result{core->counters(), toString(core->state()), core->identity(), 0.0, 0.0, 0.0};
  if (const ClockFilter* clock = core->clock()) {
    result.offset_s = clock->offset() + 1e-9 * static_cast<double>(realTimeOffset());
    result.skew_ppm = 1e6 * clock->skew();
    result.sigma_us = 1e6 * clock->sigma();
  }
  return result;
}

}  // namespace segway_drivers
