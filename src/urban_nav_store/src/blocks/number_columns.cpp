// SPDX-License-Identifier: BSD-3-Clause
#include "blocks/number_columns.hpp"

namespace urban_nav_store {

void appendColumn(std::string& bytes, const std::vector<std::uint32_t>& values, int width) {
  for (int byte = 0; byte < width; ++byte) {
    std::uint32_t last = 0;
    for (const std::uint32_t value : values) {
      bytes.push_back(static_cast<char>((value - last) >> (8 * byte) & 0xffU));
      last = value;
    }
  }
}

std::vector<std::uint32_t> takeColumn(std::string_view& bytes, std::size_t count, int width) {
  std::vector<std::uint32_t> values(count, 0);
  for (int byte = 0; byte < width; ++byte)
    for (std::size_t i = 0; i < count; ++i) {
      const auto part = static_cast<unsigned char>(bytes[static_cast<std::size_t>(byte) * count + i]);
      values[i] |= static_cast<std::uint32_t>(part) << (8 * byte);
    }
  const std::uint32_t mask = width >= 4 ? ~0U : (1U << (8 * width)) - 1U;
  std::uint32_t last = 0;
  for (std::uint32_t& value : values) last = value = (value + last) & mask;
  bytes.remove_prefix(count * static_cast<std::size_t>(width));
  return values;
}

void appendPlanes(std::string& bytes, const std::vector<std::uint64_t>& values, int width) {
  for (int byte = 0; byte < width; ++byte)
    for (const std::uint64_t value : values) bytes.push_back(static_cast<char>(value >> (8 * byte) & 0xffU));
}

std::vector<std::uint64_t> takePlanes(std::string_view& bytes, std::size_t count, int width) {
  std::vector<std::uint64_t> values(count, 0);
  for (int byte = 0; byte < width; ++byte)
    for (std::size_t i = 0; i < count; ++i) {
      const auto part = static_cast<unsigned char>(bytes[static_cast<std::size_t>(byte) * count + i]);
      values[i] |= static_cast<std::uint64_t>(part) << (8 * byte);
    }
  bytes.remove_prefix(count * static_cast<std::size_t>(width));
  return values;
}

}  // namespace urban_nav_store
