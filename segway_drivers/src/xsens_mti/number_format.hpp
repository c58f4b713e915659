// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Formats of numbers: 0 float32, 1 fixed 12.20, 2 fixed 16.32 (fraction first), 3 float64.
inline std::size_t mtiNumberSize(unsigned format) {
  constexpr std::size_t kSizes[] = {4, 4, 6, 8};
  return kSizes[format & 3U];
}

inline double readMtiNumber(const std::uint8_t* bytes, unsigned format) {
  switch (format & 3U) {
    case 0: return bigFloat(bytes);
    case 1: return static_cast<std::int32_t>(bigWord32(bytes)) / 1048576.0;
    case 2: return static_cast<std::int16_t>(bigWord(bytes + 4)) + bigWord32(bytes) / 4294967296.0;
    default: return bigDouble(bytes);
  }
}

}  // namespace segway_drivers
