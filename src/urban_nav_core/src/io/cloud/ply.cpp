// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "formats.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::cloud_formats {
namespace {

struct Property {
  std::string name;
  BinaryNumber number;
  std::optional<BinaryNumber> length;  // of a list: type of its length
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

BinaryNumber parseBinaryNumber(std::string_view word, const std::string& where) {
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

Format parseFormat(std::string_view word, const std::string& where) {
  if (word == "ascii") return Format::Ascii;
  if (word == "binary_little_endian") return Format::Little;
  if (word == "binary_big_endian") return Format::Big;
  throw UserError(where, "format " + std::string(word), "ascii, binary_little_endian, binary_big_endian");
}

void readPlyHeaderLine(const std::vector<std::string_view>& words, PlyHeader& header, const std::string& where) {
  if (words[0] == "format" && words.size() >= 2) {
    header.format = parseFormat(words[1], where);
  } else if (words[0] == "element" && words.size() == 3) {
    const auto count = parseInteger(words[2]);
    if (!count || *count < 0) throw UserError(where, "element count " + std::string(words[2]), "a whole number");
    header.elements.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
  } else if (words[0] == "property" && words.size() == 3 && !header.elements.empty()) {
    header.elements.back().properties.push_back({std::string(words[2]), parseBinaryNumber(words[1], where), {}});
  } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" && !header.elements.empty()) {
    const BinaryNumber length = parseBinaryNumber(words[2], where);
    if (length.kind == 'F') throw UserError(where, "a list whose length is not an integer type", "uchar, int, ...");
    header.elements.back().properties.push_back({std::string(words[4]), parseBinaryNumber(words[3], where), length});
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

/// Columns of three properties; empty if one is missing or a list.
using Columns = std::array<std::size_t, 3>;
std::optional<Columns> findColumns(const Element& vertex, const std::array<const char*, 3>& names) {
  Columns columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t at = 0;
    while (at < vertex.properties.size() && vertex.properties[at].name != names[axis]) ++at;
    if (at == vertex.properties.size() || vertex.properties[at].length) return std::nullopt;
    columns[axis] = at;
  }
  return columns;
}

/// Columns of the properties of a vertex.
struct Vertex {
  Columns point{};
  std::optional<Columns> origin;
};

Vertex parseVertex(const Element& element, const std::string& name) {
  const auto point = findColumns(element, {"x", "y", "z"});
  if (!point) throw UserError(name, "element vertex lacks x, y or z", "x, y, z, each a number");
  return {*point, findColumns(element, {"origin_x", "origin_y", "origin_z"})};
}

UserError tooShort(const std::string& name, const Element& element) {
  return UserError(name, "ends before its " + std::to_string(element.count) + " of element " + element.name,
                   "a complete file");
}

/// Reads the numbers of a binary file in sequence, in either byte order.
class BinaryNumbers {
 public:
  BinaryNumbers(std::string_view bytes, bool swap) : bytes_(bytes), swap_(swap) {}

  std::optional<double> next(BinaryNumber number) {
    if (number.size > bytes_.size() - at_) return std::nullopt;
    const double value = readBinary(&bytes_[at_], number, swap_);
    at_ += number.size;
    return value;
  }
  bool skip(std::size_t count, BinaryNumber number) {
    if (count > (bytes_.size() - at_) / number.size) return false;
    at_ += count * number.size;
    return true;
  }
  std::size_t left() const { return bytes_.size() - at_; }
  void expectEnd() const {}  // padding does no harm

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool swap_;
};

/// Reads words separated by blanks and line ends, which are equivalent in the format.
class AsciiNumbers {
 public:
  AsciiNumbers(HeaderLines& lines, std::string name) : lines_(lines), name_(std::move(name)) {}

  std::optional<double> next(BinaryNumber) {
    const auto word = nextWord();
    if (!word) return std::nullopt;
    const auto value = parseCell(*word);
    if (!value)
      throw UserError(atLine(name_, lines_.number()), "`" + std::string(word->substr(0, 40)) + "`", "a number");
    return value;
  }
  bool skip(std::size_t count, BinaryNumber) {
    while (count > 0 && nextWord()) --count;
    return count == 0;
  }
  std::size_t left() const { return words_.size() - at_ + lines_.rest().size(); }
  /// Rejects a row with too many numbers, which would shift all following ones.
  void expectEnd() {
    if (nextWord())
      throw UserError(atLine(name_, lines_.number()), "more numbers than declared in the header", "as many");
  }

 private:
  std::optional<std::string_view> nextWord() {
    while (at_ >= words_.size()) {
      const auto line = lines_.next();
      if (!line) return std::nullopt;
      words_ = splitBlanks(*line);
      at_ = 0;
    }
    return words_[at_++];
  }

  HeaderLines& lines_;
  std::string name_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

/// Reads one row of an element into `row`; lists are skipped and yield 0. Returns whether the row is complete.
template <class Numbers>
bool readRow(const Element& element, Numbers& numbers, std::vector<double>& row) {
  row.clear();
  for (const Property& property : element.properties) {
    const auto value = numbers.next(property.length ? *property.length : property.number);
    if (!value) return false;
    row.push_back(property.length ? 0.0 : *value);
    if (!property.length) continue;
    if (!(*value >= 0.0 && *value <= static_cast<double>(numbers.left()))) return false;
    if (!numbers.skip(static_cast<std::size_t>(*value), property.number)) return false;
  }
  return true;
}

Eigen::Vector3d pick(const Columns& columns, const std::vector<double>& row) {
  return {row[columns[0]], row[columns[1]], row[columns[2]]};
}

/// Calls begin(element) for the first element `vertex`, then take(row) for each of its rows.
template <class Numbers, class Begin, class Take>
void forEachVertex(const PlyHeader& header, Numbers& numbers, const std::string& name, const Begin& begin,
                   const Take& take) {
  std::vector<double> row;
  bool is_found = false;
  for (const Element& element : header.elements) {
    const bool vertices = element.name == "vertex" && !is_found;
    if (vertices) begin(element);
    is_found = is_found || vertices;
    for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      if (!readRow(element, numbers, row)) throw tooShort(name, element);
      if (vertices) take(row);
    }
  }
  if (!is_found) throw UserError(name, "no element vertex", "a PLY file of points");
  numbers.expectEnd();
}

template <class Begin, class Take>
void forEachPlyVertex(std::string_view content, const std::string& name, const Begin& begin, const Take& take) {
  HeaderLines lines(content);
  const PlyHeader header = readPlyHeader(lines, name);
  if (header.format == Format::Ascii) {
    AsciiNumbers numbers(lines, name);
    return forEachVertex(header, numbers, name, begin, take);
  }
  BinaryNumbers numbers(lines.rest(), header.format == Format::Big);
  forEachVertex(header, numbers, name, begin, take);
}

}  // namespace

Vertices parsePly(std::string_view content, const std::string& name) {
  Vertices found;
  Vertex vertex;
  forEachPlyVertex(
      content, name,
      [&](const Element& element) {
        vertex = parseVertex(element, name);
        const std::size_t least = element.properties.size();  // bytes of a vertex
        found.points.reserve(std::min(element.count, content.size() / least));
        if (vertex.origin) found.origins.reserve(found.points.capacity());
      },
      [&](const std::vector<double>& row) {
        found.points.push_back(pick(vertex.point, row));
        if (vertex.origin) found.origins.push_back(pick(*vertex.origin, row));
      });
  return found;
}

NumberColumns parsePlyColumns(std::string_view content, const std::string& name,
                              const std::vector<std::string>& wanted) {
  NumberColumns columns(wanted.size());
  std::vector<std::size_t> places(wanted.size(), 0);
  const auto begin = [&](const Element& element) {
    for (std::size_t i = 0; i < wanted.size(); ++i)
      for (std::size_t at = element.properties.size(); at-- > 0;)
        if (element.properties[at].name == wanted[i] && !element.properties[at].length) {
          places[i] = at;
          columns[i].emplace();
        }
  };
  forEachPlyVertex(content, name, begin, [&](const std::vector<double>& row) {
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (columns[i]) columns[i]->push_back(row[places[i]]);
  });
  return columns;
}

}  // namespace urban_nav_core::cloud_formats
