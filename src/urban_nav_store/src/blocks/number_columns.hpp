// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_store {

/// Appends numbers byte by byte in columns, least significant first. Each number is replaced by its difference to the
/// previous one, modulo 2^(8 bytes), so that smooth columns compress well.
void appendColumn(std::string& bytes, const std::vector<std::uint32_t>& values, int width);

/// Inverse of appendColumn() for `count` numbers, whose bytes are removed. Requires count * width bytes.
std::vector<std::uint32_t> takeColumn(std::string_view& bytes, std::size_t count, int width);

/// Appends numbers byte by byte in columns, least significant first, without differences.
void appendPlanes(std::string& bytes, const std::vector<std::uint64_t>& values, int width);

/// Inverse of appendPlanes() for `count` numbers, whose bytes are removed. Requires count * width bytes.
std::vector<std::uint64_t> takePlanes(std::string_view& bytes, std::size_t count, int width);

/// Maps integers of either sign and small magnitude to small numbers: 0, -1, 1, -2 ... to 0, 1, 2, 3 ...; and back.
inline std::uint64_t toUnsigned(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
inline std::int64_t toSigned(std::uint64_t value) {
  return static_cast<std::int64_t>((value >> 1) ^ (~(value & 1U) + 1U));
}

}  // namespace urban_nav_store
