// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/io/cloud/record_file.hpp"

namespace urban_nav_core {
/// Number type of a property of a PLY file.
enum class PlyType { Float, Double, UChar, UShort, Int };
/// A named property of a PLY element.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float;
};

/// Properties of the vertices of a PLY file (Turk 1994) and comments of its header.
struct PlyLayout {
  std::vector<PlyProperty> properties;
  std::vector<std::string> comments;  ///< one line each

  /// Returns the size of one vertex in bytes.
  std::size_t vertexBytes() const;
};

/// Returns the header of a binary little-endian file with this many vertices. The vertices follow it, each with its
/// properties in order and without padding.
std::string plyHeader(const PlyLayout& layout, std::size_t vertices);

/// Appends the bytes of a number in little-endian order.
template <typename Number>
void appendLittleEndian(std::string& bytes, Number value);

/// Writes a binary PLY file whose number of vertices need not be known in advance. The file is written completely or
/// not at all. Not thread-safe. Throws UserError or DataError naming the path.
class PlyWriter {
 public:
  PlyWriter(const std::string& path, PlyLayout layout);

  /// Appends vertices. Requires a whole number of them.
  void append(std::string_view vertices) { file_.append(vertices); }
  std::size_t vertices() const { return file_.records(); }
  /// Writes the header and renames the file to its final name.
  void commit();

 private:
  PlyLayout layout_;
  RecordFile file_;
};

extern template void appendLittleEndian(std::string&, float);
extern template void appendLittleEndian(std::string&, double);
extern template void appendLittleEndian(std::string&, std::uint8_t);
extern template void appendLittleEndian(std::string&, std::uint16_t);
extern template void appendLittleEndian(std::string&, std::uint32_t);
extern template void appendLittleEndian(std::string&, std::int32_t);

}  // namespace urban_nav_core
