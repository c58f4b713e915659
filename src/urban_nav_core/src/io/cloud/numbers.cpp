// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstring>

#include "formats.hpp"
#include "urban_nav_core/io/text_file.hpp"

namespace urban_nav_core::cloud_formats {
namespace {

template <typename Number>
double as(const std::array<char, 8>& bytes) {
  Number value{};
  std::memcpy(&value, bytes.data(), sizeof(value));
  return static_cast<double>(value);
}

}  // namespace

std::string decodeContent(std::string_view content) {
  for (const std::string_view magic : {"ply\n", "ply\r", "LASF", "# .PCD"})
    if (content.substr(0, magic.size()) == magic) return {};
  // A byte order mark, or UTF-16 without one, is detected from the beginning.
  const std::string head(content.substr(0, 512));
  return decodeText(head) == head ? std::string() : decodeText(std::string(content));
}

double readBinary(const char* bytes, BinaryNumber number, bool swap) {
  std::array<char, 8> copy{};
  std::memcpy(copy.data(), bytes, number.size);
  if (swap) std::reverse(copy.begin(), copy.begin() + static_cast<std::ptrdiff_t>(number.size));
  if (number.kind == 'F') return number.size == 4 ? as<float>(copy) : as<double>(copy);
  const bool is_signed = number.kind == 'I';
  switch (number.size) {
    case 1: return is_signed ? as<std::int8_t>(copy) : as<std::uint8_t>(copy);
    case 2: return is_signed ? as<std::int16_t>(copy) : as<std::uint16_t>(copy);
    case 4: return is_signed ? as<std::int32_t>(copy) : as<std::uint32_t>(copy);
    default: return is_signed ? as<std::int64_t>(copy) : as<std::uint64_t>(copy);
  }
}

std::optional<std::string_view> HeaderLines::next() {
  if (position_ >= content_.size()) return std::nullopt;
  const std::size_t end = content_.find('\n', position_);
  const std::size_t stop = std::min(end, content_.size());
  std::string_view line = content_.substr(position_, stop - position_);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  position_ = end == std::string_view::npos ? content_.size() : end + 1;
  ++number_;
  return line;
}

}  // namespace urban_nav_core::cloud_formats
