// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace urban_nav_store {

/// Append numbers as little-endian bytes, for digests and for blocks of the store. States use
/// urban_nav_core/io/archive.hpp.
void appendInteger(std::string& bytes, std::uint64_t value);
void appendInteger32(std::string& bytes, std::uint32_t value);
void appendNumber(std::string& bytes, double value);
void appendFloat(std::string& bytes, float value);
/// Appends the length of the text, then the text.
void appendText(std::string& bytes, std::string_view text);

/// Reads the output of the functions above. Values past the end are zero or empty, and ok() is false from then on:
/// check it at the end, and before using the count of items that follow.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t integer();
  std::uint32_t integer32();
  double number();
  float real32();
  std::string_view text();

  bool ok() const { return ok_; }
  /// Returns whether all bytes were read and none was missing.
  bool complete() const { return ok_ && bytes_.empty(); }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view take(std::size_t size);

  std::string_view bytes_;
  bool ok_ = true;
};

}  // namespace urban_nav_store
