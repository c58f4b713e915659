// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// Appends little-endian numbers and length-prefixed byte strings.
class ByteWriter {
 public:
  template <typename T>
  ByteWriter& number(T value) {
    static_assert(std::is_integral_v<T>, "a fixed-size integer");
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    bytes_.append(bytes, sizeof(T));
    return *this;
  }
  ByteWriter& text(const std::string& text) {
    number(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
    return *this;
  }
  ByteWriter& bytes(ByteView view) {
    if (view.size > 0) bytes_.append(reinterpret_cast<const char*>(view.data), view.size);
    return *this;
  }
  ByteWriter& bytes(const std::string& more) {
    bytes_ += more;
    return *this;
  }

  std::size_t size() const { return bytes_.size(); }
  const std::string& str() const { return bytes_; }
  ByteView view() const { return {reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size()}; }
  void clear() { bytes_.clear(); }

 private:
  std::string bytes_;
};

}  // namespace urban_nav_input
