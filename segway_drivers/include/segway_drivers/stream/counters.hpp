// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace segway_drivers {

/// Counts of one device since its driver was started; shown in the diagnostics.
struct DeviceCounters {
  std::int64_t bytes = 0;          ///< received
  std::int64_t frames = 0;         ///< with a correct checksum, of all kinds
  std::int64_t bad_checksums = 0;  ///< complete frames whose checksum is wrong, false starts included
  std::int64_t bytes_skipped = 0;  ///< bytes that belong to no frame
  std::int64_t gaps = 0;           ///< measurements missing by the device's counter
  std::int64_t unexpected = 0;     ///< replies and messages that nothing asked for
  std::int64_t timeouts = 0;       ///< replies that did not come, frames that did not end
  std::int64_t stalls = 0;         ///< times that a stream fell silent
  std::int64_t reconnections = 0;  ///< times that the port was opened again
  std::int64_t epochs = 0;         ///< times that the estimate of the device clock began again after the first
};

}  // namespace segway_drivers
