// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace urban_nav_store {

/// Numbers as bytes, little-endian on every machine: for blocks of the store and for the states of stages.
void appendInteger(std::string& bytes, std::uint64_t value);
void appendInteger32(std::string& bytes, std::uint32_t value);
void appendNumber(std::string& bytes, double value);
void appendFloat(std::string& bytes, float value);
/// With its length in front.
void appendText(std::string& bytes, std::string_view text);

/// Reads them again. What is asked for behind the end is zero or empty, and ok() is false from then on: a reader of damaged
/// bytes asks at its end, and before it trusts a number of things to come.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t integer();
  std::uint32_t integer32();
  double number();
  float real32();
  std::string_view text();

  bool ok() const { return ok_; }
  /// All is read, and nothing was missing.
  bool complete() const { return ok_ && bytes_.empty(); }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view take(std::size_t size);

  std::string_view bytes_;
  bool ok_ = true;
};

}  // namespace urban_nav_store
