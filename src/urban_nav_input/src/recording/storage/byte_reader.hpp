// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// Reads little-endian numbers and length-prefixed byte strings in order. Beyond the end, values are 0 or empty, and
/// isGood() is false.
class ByteReader {
 public:
  explicit ByteReader(ByteView bytes) : at_(bytes.data), end_(bytes.data + bytes.size) {}

  bool isGood() const { return is_good_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  template <typename T>
  T number() {
    static_assert(std::is_integral_v<T>, "a fixed-size integer");
    T value = 0;
    if (const ByteView taken = bytes(sizeof(T)); taken.data != nullptr) std::memcpy(&value, taken.data, sizeof(T));
    return value;
  }
  /// Returns the next bytes; no data if there are fewer.
  ByteView bytes(std::size_t size) {
    if (!is_good_ || size > left()) {
      is_good_ = false;
      at_ = end_;
      return {};
    }
    const ByteView taken{at_, size};
    at_ += size;
    return taken;
  }
  std::string text() {
    const ByteView taken = bytes(number<std::uint32_t>());
    return taken.size == 0 ? std::string() : std::string(reinterpret_cast<const char*>(taken.data), taken.size);
  }
  ByteView rest() { return bytes(left()); }

 private:
  const std::uint8_t* at_;
  const std::uint8_t* end_;
  bool is_good_ = true;
};

}  // namespace urban_nav_input
