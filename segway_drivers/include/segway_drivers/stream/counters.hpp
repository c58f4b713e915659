// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace segway_drivers {

/// Counts of one device since the start of its driver; shown in the diagnostics.
struct DeviceCounters {
  std::int64_t bytes = 0;          ///< received
  std::int64_t frames = 0;         ///< with a correct checksum, of all kinds
  std::int64_t bad_checksums = 0;  ///< complete frames whose checksum is wrong, false starts included
  std::int64_t bytes_skipped = 0;  ///< bytes outside frames
  std::int64_t gaps = 0;           ///< measurements missing by the device counter
  std::int64_t unexpected = 0;     ///< unrequested replies and messages
  std::int64_t timeouts = 0;       ///< missing replies, incomplete frames
  std::int64_t stalls = 0;         ///< interruptions of a stream
  std::int64_t reconnections = 0;  ///< times that the port was reopened
  std::int64_t epochs = 0;         ///< restarts of the estimate of the device clock
};

}  // namespace segway_drivers
