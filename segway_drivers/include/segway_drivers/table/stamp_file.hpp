// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace segway_drivers {
/// A table of device times whose stamps are estimated, and the parameters of the device clock.
struct StampJob {
  std::string input;          ///< CSV `device_s,arrival_ns` in order of arrival
  std::string output;         ///< CSV `stamp_ns,sigma_ns,epoch`, one row per input row
  double period = 0.01;       ///< s, nominal spacing of the device times
  double tolerance = 200e-6;  ///< s/s, largest skew
  double latency = 0.0;       ///< s, subtracted from each stamp
};
/// Rows and estimated clock of a stamped table.
struct StampResult {
  std::int64_t rows = 0, epochs = 0;
  double skew_ppm = 0.0, sigma_us = 0.0;  ///< at the end
};

/// Runs the clock filter over a table. Throws UserError with file and line.
StampResult stampFile(const StampJob& job);

}  // namespace segway_drivers
