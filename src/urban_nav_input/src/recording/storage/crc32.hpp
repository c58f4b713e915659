// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// Returns the CRC-32 of zlib and IEEE 802.3, continued from that of the previous bytes (0 at the beginning). Computed
/// for every byte of a recording; twice as fast as zlib on processors with carry-less multiplication.
std::uint32_t crc32(ByteView bytes, std::uint32_t before = 0);

}  // namespace urban_nav_input
