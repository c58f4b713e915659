// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace loop_metric {

/// A picture in colour: blue, green, red in a byte each ("bgr8" in ROS), rows from the top without gaps.
struct Picture {
  int width = 0, height = 0;  ///< px
  std::vector<std::uint8_t> bgr;
};

/// As JPEG; empty for an empty picture. `quality`: 1...100.
std::vector<std::uint8_t> jpegOf(const Picture& picture, int quality = 85);

}  // namespace loop_metric
