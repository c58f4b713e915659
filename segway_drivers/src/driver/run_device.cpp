// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/driver/run_device.hpp"

#include <cmath>

#include "segway_drivers/driver/driver_options.hpp"
#include "segway_drivers/table/row_decoder.hpp"
#include "segway_drivers/transport/host_clock.hpp"
#include "table/rows.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

using urban_nav_core::UserError;

namespace {

constexpr TimeNs kRunWait = 2'000'000;  // ns

/// Writes messages with stamps of real time.
class RunTable {
 public:
  RunTable(const std::string& path, const std::string& kind) : file_(path) {
    file_.write("frame,offset,stamp_ns," + rowColumns(kind) + "\n");
  }
  /// `stamp`: steady time.
  void add(std::optional<TimeNs> stamp, const std::string& cells) {
    if (!stamp) return;
    file_.write(std::to_string(frame_++) + ",," + std::to_string(clock_.toReal(*stamp)) + "," + cells + "\n");
  }
  /// Returns the size of a step of the host clock, ns.
  TimeNs followHostClock() { return clock_.follow(); }
  void commit() { file_.commit(); }

 private:
  urban_nav_core::AtomicFile file_;
  HostClock clock_;
  std::int64_t frame_ = 0;
};

}  // namespace

std::vector<DriveWish> readDriveFile(const std::string& path) {
  const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::read(path);
  const std::size_t time = table.column("t_s"), linear = table.column("linear_mps"),
                    angular = table.column("angular_radps");
  std::vector<DriveWish> wishes;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t = table.number(row, time);
    if (t < 0.0 || t > 1e6 || (!wishes.empty() && 1e9 * t < static_cast<double>(wishes.back().time)))
      throw UserError(table.where(row), "t_s = " + table.text(row, time), "0...1000000 s, non-decreasing");
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
  if (job.kind == "lms291") {
    auto driver = std::make_unique<LmsDriver>(toLmsOptions(parameters));
    driver->on_scan = [&table](const LmsStampedScan& scan) { table.add(scan.stamp, lmsCells(scan.scan)); };
    core = std::move(driver);
  } else if (job.kind == "xsens_mti") {
    auto driver = std::make_unique<MtiDriver>(toMtiOptions(parameters));
    driver->on_sample = [&table](const MtiStampedSample& sample) { table.add(sample.stamp, mtiCells(sample.sample)); };
    core = std::move(driver);
  } else if (job.kind == "gps") {
    auto driver = std::make_unique<GpsDriver>(toGpsOptions(parameters, job.port));
    driver->on_fix = [&table](const GpsFix& fix, std::optional<TimeNs> stamp) { table.add(stamp, gpsCells(fix)); };
    core = std::move(driver);
  } else if (job.kind == "segway_rmp") {
    auto driver = std::make_unique<RmpDriver>(toRmpOptions(parameters));
    driver->on_frame = [&table](const RmpStampedFrame& frame) { table.add(frame.stamp, rmpCells(frame.frame)); };
    base = driver.get();
    core = std::move(driver);
  } else {
    throw UserError("KIND", job.kind + " cannot be run", "lms291, xsens_mti, segway_rmp, gps");
  }
  if (base == nullptr && !wishes.empty()) throw UserError("--drive", job.kind, "segway_rmp");

  DriverLoop loop(*core, job.port);
  loop.open();
  if (!loop.remark().empty()) report({true, job.port + ": " + loop.remark()});
  const TimeNs begin = steadyTime(), end = begin + static_cast<TimeNs>(std::llround(1e9 * job.duration));
  std::size_t next_wish = 0;
  for (TimeNs now = begin; now < end; now = steadyTime()) {
    for (; base != nullptr && next_wish < wishes.size() && wishes[next_wish].time <= now - begin; ++next_wish)
      base->guard().setWish(wishes[next_wish].wish, now);
    loop.step(std::min(kRunWait, end - now));
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
