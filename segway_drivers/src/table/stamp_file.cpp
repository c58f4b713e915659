// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/table/stamp_file.hpp"

#include <cmath>

#include "segway_drivers/clock/clock_filter.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

StampResult stampFile(const StampJob& job) {
  const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::read(job.input);
  const std::size_t device = table.column("device_s"), arrival = table.column("arrival_ns");
  ClockOptions options;
  options.period = job.period;
  options.tolerance = options.hard_tolerance = job.tolerance;
  ClockFilter filter(options);
  const auto latency = static_cast<TimeNs>(std::llround(1e9 * job.latency));
  std::string text = "stamp_ns,sigma_ns,epoch\n";
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double device_s = table.number(row, device);
    if (std::abs(device_s) > 1e12)
      throw urban_nav_core::UserError(table.where(row), table.text(row, device), "seconds");
    const ClockEstimate estimate = filter.add(device_s, table.integer(row, arrival));
    if (estimate.time) text += std::to_string(*estimate.time - latency);
    text += "," + std::to_string(std::llround(1e9 * estimate.sigma)) + "," + std::to_string(estimate.epoch) + "\n";
  }
  urban_nav_core::writeAtomically(job.output, text);
  return {static_cast<std::int64_t>(table.rows()), filter.epoch(), 1e6 * filter.skew(), 1e6 * filter.sigma()};
}

}  // namespace segway_drivers
