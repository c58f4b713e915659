// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace fabmap_node {

/// Appends an integer in base 128, least significant digits first, with the high bit set on all but the last.
inline void putNumber(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (; value >= 128; value >>= 7) bytes.push_back(static_cast<std::uint8_t>(value | 128u));
  bytes.push_back(static_cast<std::uint8_t>(value));
}

/// Reads the output of putNumber(). The bytes must outlive it.
class NumberReader {
 public:
  explicit NumberReader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  bool atEnd() const { return at_ == bytes_.size(); }
  /// Returns the next number; `isValid` becomes false at a damaged one.
  std::uint32_t next() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      if (atEnd()) break;
      const std::uint8_t byte = bytes_[at_++];
      value |= static_cast<std::uint64_t>(byte & 127u) << shift;
      if (byte < 128) return static_cast<std::uint32_t>(std::min<std::uint64_t>(value, 0xffffffffu));
    }
    valid_ = false;
    return 0;
  }
  bool isValid() const { return valid_; }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
  bool valid_ = true;
};

}  // namespace fabmap_node
