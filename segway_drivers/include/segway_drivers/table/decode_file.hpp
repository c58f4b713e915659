// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "segway_drivers/parameters.hpp"
#include "segway_drivers/stream/counters.hpp"

namespace segway_drivers {

struct DecodeJob {
  std::string kind;      ///< one of deviceKinds()
  std::string input;     ///< bytes as the device sent them
  std::string output;    ///< CSV; images of cameras are written beside it
  std::string arrivals;  ///< CSV `offset,arrival_ns` of the reads, or empty: no stamps
  int chunk = 4096;      ///< bytes per call; 0: random lengths. Without effect on the result
  std::uint64_t seed = 1;
};

/// Decodes a file of bytes into `frame,offset,stamp_ns` and the columns of the kind. Throws UserError naming the file,
/// and DataError with the likely protocol for bytes of a receiver (kind gps) without a whole frame.
DeviceCounters decodeFile(const DecodeJob& job, const Parameters& parameters);

}  // namespace segway_drivers
