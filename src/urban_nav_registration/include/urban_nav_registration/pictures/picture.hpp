// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace urban_nav_registration {

/// Colour image: blue, green, red in a byte each ("bgr8" in ROS), rows from the top without gaps.
struct Picture {
  int width = 0, height = 0;  ///< px
  std::vector<std::uint8_t> bgr;
};

/// Returns the JPEG of a picture; empty for an empty picture. `quality`: 1...100.
std::vector<std::uint8_t> encodeJpeg(const Picture& picture, int quality = 85);

/// Decodes a JPEG. Returns an empty picture if the bytes are damaged or not a JPEG, or if it is larger than 100 million
/// pixels. Thread-safe.
Picture decodePicture(std::string_view jpeg);

}  // namespace urban_nav_registration
