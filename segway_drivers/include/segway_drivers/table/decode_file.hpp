// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "segway_drivers/parameters.hpp"
#include "segway_drivers/stream/counters.hpp"

namespace segway_drivers {
/// A recorded byte stream of a device and the files of its decoded measurements.
struct DecodeJob {
  std::string kind;      ///< one of deviceKinds()
  std::string input;     ///< bytes as sent by the device
  std::string output;    ///< CSV; images of cameras are written to its folder
  std::string arrivals;  ///< CSV `offset,arrival_ns` of the reads; empty: no stamps
  int chunk = 4096;      ///< bytes per call; 0: random lengths; no effect on the result
  std::uint64_t seed = 1;
};

/// Decodes a file of bytes into `frame,offset,stamp_ns` and the columns of the kind. Throws UserError with the file,
/// and DataError with the likely protocol for bytes of a receiver (kind gps) without a complete frame.
DeviceCounters decodeFile(const DecodeJob& job, const Parameters& parameters);

}  // namespace segway_drivers
