// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/ply_writer.hpp"

#include <cstring>
#include <utility>

namespace urban_nav_core {
namespace {

constexpr std::size_t kCountDigits = 20;  // of the largest number of vertices

std::size_t plyBytes(PlyType type) {
  switch (type) {
    case PlyType::Float:
    case PlyType::Int: return 4;
    case PlyType::Double: return 8;
    case PlyType::UShort: return 2;
    case PlyType::UChar: return 1;
  }
  return 0;
}

const char* plyName(PlyType type) {
  switch (type) {
    case PlyType::Float: return "float";
    case PlyType::Double: return "double";
    case PlyType::UChar: return "uchar";
    case PlyType::UShort: return "ushort";
    case PlyType::Int: return "int";
  }
  return "";
}

}  // namespace

std::size_t PlyLayout::vertexBytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties) bytes += plyBytes(property.type);
  return bytes;
}

std::string plyHeader(const PlyLayout& layout, std::size_t vertices) {
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : layout.comments) header += "comment " + comment + "\n";
  header += "element vertex " + std::to_string(vertices) + "\n";
  for (const PlyProperty& property : layout.properties)
    header += std::string("property ") + plyName(property.type) + " " + property.name + "\n";
  return header + "end_header\n";
}

template <typename Number>
void appendLittleEndian(std::string& bytes, Number value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  for (std::size_t i = 0; i < sizeof value / 2; ++i) std::swap(raw[i], raw[sizeof value - 1 - i]);
#endif
  bytes.append(raw, sizeof value);
}

template void appendLittleEndian(std::string&, float);
template void appendLittleEndian(std::string&, double);
template void appendLittleEndian(std::string&, std::uint8_t);
template void appendLittleEndian(std::string&, std::uint16_t);
template void appendLittleEndian(std::string&, std::uint32_t);
template void appendLittleEndian(std::string&, std::int32_t);

// The header's length must not depend on the number of vertices: a comment is padded with blanks.
PlyWriter::PlyWriter(const std::string& path, PlyLayout layout)
    : layout_([&] {
        layout.comments.emplace_back(kCountDigits, ' ');
        return std::move(layout);
      }()),
      file_(path, plyHeader(layout_, 0).size(), layout_.vertexBytes()) {}

void PlyWriter::commit() {
  layout_.comments.back().resize(kCountDigits + 1 - std::to_string(vertices()).size());
  file_.commit(plyHeader(layout_, vertices()));
}

}  // namespace urban_nav_core
