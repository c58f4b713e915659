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

/// Parsers of the formats of readCloud(), each in a file of its name.
namespace urban_nav_core::cloud_formats {

/// Points of a file, m; `origins` is empty if the file has none.
struct Vertices {
  std::vector<Eigen::Vector3d> points, origins;
};

Vertices parsePly(std::string_view content, const std::string& name);
/// Returns the properties `wanted` of the element vertex; lists are ignored.
NumberColumns parsePlyColumns(std::string_view content, const std::string& name,
                              const std::vector<std::string>& wanted);
Vertices parsePcd(std::string_view content, const std::string& name);
Vertices parseLas(std::string_view content, const std::string& name);
/// Returns x, y, z, `intensity`, `classification` and attributes ("extra bytes") by their names.
NumberColumns parseLasColumns(std::string_view content, const std::string& name,
                              const std::vector<std::string>& wanted);
Vertices parsePoints(std::string_view content, const std::string& name);  // CSV and similar text formats

bool isGzip(std::string_view content);
/// Returns the decompressed content. Throws UserError if the stream is damaged, truncated, or decompresses to more than
/// largestPiece().
std::string gunzip(std::string_view content, const std::string& name);

/// Returns the number of line ends, an upper bound of the points in a text file. Reserving it at once takes a third of
/// the memory of a growing vector.
std::size_t countLines(std::string_view content);

/// LZF (Lehmann 2000, the compression of PCD files): a control byte c below 32 is followed by c + 1 literal bytes;
/// otherwise its top three bits (7: plus another byte) are the length of a copy minus 2, and the other thirteen bits
/// its distance minus 1. Empty if the input is damaged or does not decompress to `size` bytes.
std::optional<std::string> decompressLzf(std::string_view packed, std::size_t size);

/// Converts UTF-16, or text with a byte order mark, to UTF-8; empty for content that needs no conversion.
std::string decodeContent(std::string_view content);

/// Format of a number in a binary file.
struct BinaryNumber {
  std::size_t size = 0;  ///< 1, 2, 4, 8
  char kind = 'F';       ///< F: floating, I: signed, U: unsigned
};
/// Reads a number of `number.size` bytes. `swap`: the byte order is that of the other endianness.
double readBinary(const char* bytes, BinaryNumber number, bool swap);

/// Reads lines and the bytes after them: text headers of binary files.
class HeaderLines {
 public:
  explicit HeaderLines(std::string_view content) : content_(content) {}
  /// Returns the next line without its line end; empty at the end of the content.
  std::optional<std::string_view> next();
  /// Returns the number of the last line read, from 1.
  int number() const { return number_; }
  std::string_view rest() const { return content_.substr(position_); }

 private:
  std::string_view content_;
  std::size_t position_ = 0;
  int number_ = 0;
};

}  // namespace urban_nav_core::cloud_formats
