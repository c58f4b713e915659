// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <map>
#include <vector>

#include "formats.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::cloud_formats {
namespace {

struct Property {
  std::string name;
  BinaryNumber number;
  std::optional<BinaryNumber> length;  // of a list: how its length is written
};
struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};
enum class Format { None, Ascii, Little, Big };
struct PlyHeader {
  Format format = Format::None;
  std::vector<Element> elements;
};

BinaryNumber numberOf(std::string_view word, const std::string& where) {
  static const std::map<std::string_view, BinaryNumber> types = {
      {"char", {1, 'I'}},  {"int8", {1, 'I'}},    {"uchar", {1, 'U'}},  {"uint8", {1, 'U'}},
      {"short", {2, 'I'}}, {"int16", {2, 'I'}},   {"ushort", {2, 'U'}}, {"uint16", {2, 'U'}},
      {"int", {4, 'I'}},   {"int32", {4, 'I'}},   {"uint", {4, 'U'}},   {"uint32", {4, 'U'}},
      {"float", {4, 'F'}}, {"float32", {4, 'F'}}, {"double", {8, 'F'}}, {"float64", {8, 'F'}}};
  const auto found = types.find(word);
  if (found == types.end())
    throw UserError(where, "property type " + std::string(word), "a type of PLY, such as float");
  return found->second;
}

Format formatOf(std::string_view word, const std::string& where) {
  if (word == "ascii") return Format::Ascii;
  if (word == "binary_little_endian") return Format::Little;
  if (word == "binary_big_endian") return Format::Big;
  throw UserError(where, "format " + std::string(word), "ascii, binary_little_endian, binary_big_endian");
}

void readPlyHeaderLine(const std::vector<std::string_view>& words, PlyHeader& header, const std::string& where) {
  if (words[0] == "format" && words.size() >= 2) {
    header.format = formatOf(words[1], where);
  } else if (words[0] == "element" && words.size() == 3) {
    const auto count = parseInteger(words[2]);
    if (!count || *count < 0) throw UserError(where, "element count " + std::string(words[2]), "a whole number");
    header.elements.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
  } else if (words[0] == "property" && words.size() == 3 && !header.elements.empty()) {
    header.elements.back().properties.push_back({std::string(words[2]), numberOf(words[1], where), {}});
  } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" && !header.elements.empty()) {
    const BinaryNumber length = numberOf(words[2], where);
    if (length.kind == 'F') throw UserError(where, "a list whose length is no whole number", "uchar, int, ...");
    header.elements.back().properties.push_back({std::string(words[4]), numberOf(words[3], where), length});
  } else if (words[0] != "comment" && words[0] != "obj_info") {
    throw UserError(where, "`" + std::string(words[0]) + "`", "format, element, property, comment, end_header");
  }
}

PlyHeader readPlyHeader(HeaderLines& lines, const std::string& name) {
  PlyHeader header;
  lines.next();  // ply
  while (const auto line = lines.next()) {
    const auto words = splitBlanks(*line);
    if (words.empty()) continue;
    if (words[0] == "end_header") {
      if (header.format == Format::None)
        throw UserError(atLine(name, lines.number()), "no format", "a line `format ...`");
      return header;
    }
    readPlyHeaderLine(words, header, atLine(name, lines.number()));
  }
  throw UserError(name, "the header does not end", "a line end_header");
}

/// The columns of three properties; empty where one is missing or a list.
using Columns = std::array<std::size_t, 3>;
std::optional<Columns> columnsOf(const Element& vertex, const std::array<const char*, 3>& names) {
  Columns columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t at = 0;
    while (at < vertex.properties.size() && vertex.properties[at].name != names[axis]) ++at;
    if (at == vertex.properties.size() || vertex.properties[at].length) return std::nullopt;
    columns[axis] = at;
  }
  return columns;
}

/// Where the numbers of a vertex stand.
struct Vertex {
  Columns point{};
  std::optional<Columns> origin;
};

Vertex vertexOf(const Element& element, const std::string& name) {
  const auto point = columnsOf(element, {"x", "y", "z"});
  if (!point) throw UserError(name, "element vertex lacks x, y or z", "x, y, z, each a number");
  return {*point, columnsOf(element, {"origin_x", "origin_y", "origin_z"})};
}

/// `number(column)`: of the row that is read.
template <class Number>
Eigen::Vector3f pick(const Columns& columns, const Number& number) {
  return {number(columns[0]), number(columns[1]), number(columns[2])};
}

/// Bytes of a row; empty where it has lists.
std::optional<std::size_t> rowSize(const Element& element) {
  std::size_t size = 0;
  for (const Property& property : element.properties) {
    if (property.length) return std::nullopt;
    size += property.number.size;
  }
  return size;
}

UserError tooShort(const std::string& name, const Element& element) {
  return UserError(name, "ends before its " + std::to_string(element.count) + " of element " + element.name,
                   "a whole file");
}

/// Past one row with lists.
std::size_t skipRow(const Element& element, std::string_view bytes, std::size_t at, bool swap,
                    const std::string& name) {
  const auto need = [&](std::size_t size) {
    if (size > bytes.size() - at) throw tooShort(name, element);
  };
  for (const Property& property : element.properties) {
    if (!property.length) {
      need(property.number.size);
      at += property.number.size;
      continue;
    }
    need(property.length->size);
    const double length = readBinary(&bytes[at], *property.length, swap);
    at += property.length->size;
    if (length < 0.0 || length > static_cast<double>(bytes.size() - at)) throw tooShort(name, element);
    const std::size_t size = static_cast<std::size_t>(length) * property.number.size;
    need(size);
    at += size;
  }
  return at;
}

PointCloud binaryVertices(const PlyHeader& header, std::string_view bytes, const std::string& name) {
  const bool swap = header.format == Format::Big;
  std::size_t at = 0;
  for (const Element& element : header.elements) {
    const auto size = rowSize(element);
    const bool vertices = element.name == "vertex";
    if (vertices && !size) throw UserError(name, "element vertex holds lists", "numbers alone");
    if (!size) {
      for (std::size_t row = 0; row < element.count; ++row) at = skipRow(element, bytes, at, swap, name);
      continue;
    }
    if (*size > 0 && element.count > (bytes.size() - at) / *size) throw tooShort(name, element);
    if (vertices) {
      const Vertex vertex = vertexOf(element, name);
      std::vector<std::size_t> offsets{0};
      for (const Property& property : element.properties) offsets.push_back(offsets.back() + property.number.size);
      PointCloud cloud;
      cloud.points.reserve(element.count);
      if (vertex.origin) cloud.origins.reserve(element.count);
      for (std::size_t row = 0; row < element.count; ++row) {
        const char* begin = bytes.data() + at + row * *size;
        const auto number = [&](std::size_t column) {
          return static_cast<float>(readBinary(begin + offsets[column], element.properties[column].number, swap));
        };
        cloud.points.push_back(pick(vertex.point, number));
        if (vertex.origin) cloud.origins.push_back(pick(*vertex.origin, number));
      }
      return cloud;
    }
    at += *size * element.count;
  }
  throw UserError(name, "no element vertex", "a PLY file of points");
}

PointCloud asciiVertices(const PlyHeader& header, HeaderLines& lines, const std::string& name) {
  for (const Element& element : header.elements) {
    const bool vertices = element.name == "vertex";
    Vertex vertex;
    if (vertices) vertex = vertexOf(element, name);
    PointCloud cloud;
    for (std::size_t row = 0; row < element.count;) {
      const auto line = lines.next();
      if (!line) throw tooShort(name, element);
      const auto words = splitBlanks(*line);
      if (words.empty()) continue;
      ++row;
      if (!vertices) continue;
      const std::string where = atLine(name, lines.number());
      if (words.size() != element.properties.size())
        throw UserError(where, std::to_string(words.size()) + " numbers", std::to_string(element.properties.size()));
      const auto number = [&](std::size_t column) {
        const auto value = parseCoordinate(words[column]);
        if (!value) throw UserError(where, "`" + std::string(words[column].substr(0, 40)) + "`", "a number");
        return *value;
      };
      cloud.points.push_back(pick(vertex.point, number));
      if (vertex.origin) cloud.origins.push_back(pick(*vertex.origin, number));
    }
    if (vertices) return cloud;
  }
  throw UserError(name, "no element vertex", "a PLY file of points");
}

}  // namespace

PointCloud parsePly(std::string_view content, const std::string& name) {
  HeaderLines lines(content);
  const PlyHeader header = readPlyHeader(lines, name);
  if (header.format == Format::Ascii) return asciiVertices(header, lines, name);
  return binaryVertices(header, lines.rest(), name);
}

}  // namespace urban_nav_core::cloud_formats
