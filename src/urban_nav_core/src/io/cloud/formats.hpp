// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/io/cloud/cloud_columns.hpp"

/// The formats of readCloud(), each in a file of its name.
namespace urban_nav_core::cloud_formats {

/// Points as a file has them, m; `origins` is empty where the file has none.
struct Vertices {
  std::vector<Eigen::Vector3d> points, origins;
};

Vertices parsePly(std::string_view content, const std::string& name);
/// Numbers of the properties `wanted` of the element vertex; lists do not count.
NumberColumns parsePlyColumns(std::string_view content, const std::string& name,
                              const std::vector<std::string>& wanted);
Vertices parsePcd(std::string_view content, const std::string& name);
Vertices parseLas(std::string_view content, const std::string& name);
Vertices parsePoints(std::string_view content, const std::string& name);  // CSV and its like

bool isGzip(std::string_view content);
/// Returns the unpacked content. Throws UserError where the stream is damaged, ends early, or holds more than
/// largestPiece().
std::string gunzip(std::string_view content, const std::string& name);

/// Returns the number of ends of lines: at least as many as a file of text has points. Room for all of them at once is
/// a third of what a vector takes that grows.
std::size_t countLines(std::string_view content);

/// LZF (Lehmann 2000, the compression of PCD files): a control byte below 32 is followed by so many literal bytes and
/// one more; else its top three bits (7: and another byte) are the length less two of a copy, the other thirteen bits
/// how far back it begins, less one. Empty where the input is damaged or does not give `size` bytes.
std::optional<std::string> decompressLzf(std::string_view packed, std::size_t size);

/// Returns a text in UTF-16, or with a byte order mark, as UTF-8; empty for content that can be read as it is.
std::string decodeContent(std::string_view content);

/// The bytes of a number in a binary file.
struct BinaryNumber {
  std::size_t size = 0;  ///< 1, 2, 4, 8
  char kind = 'F';       ///< F: floating, I: signed, U: unsigned
};
/// `bytes` points at as many as its size; `swap`: of the other byte order.
double readBinary(const char* bytes, BinaryNumber number, bool swap);

/// Lines one after another, each with its number, and what follows them: headers of text before bytes.
class HeaderLines {
 public:
  explicit HeaderLines(std::string_view content) : content_(content) {}
  /// The next line without its end; empty at the end of the content.
  std::optional<std::string_view> next();
  /// Of the line that came last, from 1.
  int number() const { return number_; }
  std::string_view rest() const { return content_.substr(position_); }

 private:
  std::string_view content_;
  std::size_t position_ = 0;
  int number_ = 0;
};

}  // namespace urban_nav_core::cloud_formats
