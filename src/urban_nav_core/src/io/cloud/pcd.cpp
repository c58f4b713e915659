// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "formats.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::cloud_formats {
namespace {

struct Field {
  std::string name;
  BinaryNumber number{4, 'F'};
  std::size_t count = 1;
  std::size_t size() const { return number.size * count; }
};
struct PcdHeader {
  std::vector<Field> fields;
  std::size_t points = 0;
  bool has_points = false;
  std::size_t width = 0, height = 1;
  std::string data;  // ascii, binary, binary_compressed
};

std::size_t wholeNumber(std::string_view word, const std::string& where, std::int64_t highest) {
  const auto number = parseInteger(word);
  if (!number || *number < 0 || *number > highest)
    throw UserError(where, "`" + std::string(word.substr(0, 40)) + "`",
                    "a whole number up to " + std::to_string(highest));
  return static_cast<std::size_t>(*number);
}

constexpr std::int64_t kMostPoints = std::int64_t{1} << 40U;

/// Reads a line with one word per field.
void readFieldLine(const std::vector<std::string_view>& words, PcdHeader& header, const std::string& where) {
  if (words.size() != header.fields.size() + 1)
    throw UserError(where,
                    std::to_string(words.size() - 1) + " words for " + std::to_string(header.fields.size()) + " fields",
                    "one for each, after the line FIELDS");
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const std::string_view word = words[i + 1];
    Field& field = header.fields[i];
    if (words[0] == "TYPE") {
      if (word != "F" && word != "I" && word != "U") throw UserError(where, "type " + std::string(word), "F, I, U");
      field.number.kind = word[0];
    } else if (words[0] == "SIZE") {
      field.number.size = wholeNumber(word, where, 8);
    } else {
      field.count = wholeNumber(word, where, 1 << 20);
    }
  }
}

void readPcdHeaderLine(const std::vector<std::string_view>& words, PcdHeader& header, const std::string& where) {
  const std::string_view key = words[0];
  const auto one = [&]() -> std::string_view {
    if (words.size() != 2)
      throw UserError(where, std::to_string(words.size() - 1) + " words after " + std::string(key), "one");
    return words[1];
  };
  if (key == "FIELDS" || key == "COLUMNS") {
    header.fields.clear();
    for (std::size_t i = 1; i < words.size(); ++i) header.fields.push_back({std::string(words[i]), {4, 'F'}, 1});
  } else if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
    readFieldLine(words, header, where);
  } else if (key == "POINTS") {
    header.points = wholeNumber(one(), where, kMostPoints);
    header.has_points = true;
  } else if (key == "WIDTH") {
    header.width = wholeNumber(one(), where, 1 << 30);
  } else if (key == "HEIGHT") {
    header.height = wholeNumber(one(), where, 1 << 30);
  } else if (key == "DATA") {
    header.data = std::string(one());
    if (header.data != "ascii" && header.data != "binary" && header.data != "binary_compressed")
      throw UserError(where, "DATA " + header.data, "ascii, binary, binary_compressed");
  } else if (key != "VERSION" && key != "VIEWPOINT") {
    throw UserError(where, "`" + std::string(key.substr(0, 40)) + "`", "a line of a PCD header");
  }
}

PcdHeader readPcdHeader(HeaderLines& lines, const std::string& name) {
  PcdHeader header;
  while (header.data.empty()) {
    const auto line = lines.next();
    if (!line) throw UserError(name, "the header does not end", "a line DATA");
    const auto words = splitBlanks(*line);
    if (!words.empty() && words[0][0] != '#') readPcdHeaderLine(words, header, atLine(name, lines.number()));
  }
  if (!header.has_points) header.points = header.width * header.height;
  for (const Field& field : header.fields) {
    const std::size_t size = field.number.size;
    if (!(size == 4 || size == 8 || (field.number.kind != 'F' && (size == 1 || size == 2))))
      throw UserError(name, "field " + field.name + " of " + std::to_string(size) + " bytes", "1, 2, 4, 8 (F: 4, 8)");
  }
  return header;
}

std::array<std::size_t, 3> findCoordinates(const PcdHeader& header, const std::string& name) {
  std::array<std::size_t, 3> columns{};
  const std::array<const char*, 3> names = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t at = 0;
    while (at < header.fields.size() && header.fields[at].name != names[axis]) ++at;
    if (at == header.fields.size() || header.fields[at].count != 1)
      throw UserError(name, std::string("no field ") + names[axis], "FIELDS with x, y, z");
    columns[axis] = at;
  }
  return columns;
}

UserError tooShort(const std::string& name, const PcdHeader& header) {
  return UserError(name, "ends before its " + std::to_string(header.points) + " points", "a complete file");
}

Vertices asciiPoints(const PcdHeader& header, HeaderLines& lines, const std::string& name) {
  const auto columns = findCoordinates(header, name);
  std::array<std::size_t, 3> words_before{};
  std::size_t row_words = 0;
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (columns[axis] == i) words_before[axis] = row_words;
    row_words += header.fields[i].count;
  }
  Vertices cloud;
  cloud.points.reserve(std::min(header.points, countLines(lines.rest()) + 1));
  while (cloud.points.size() < header.points) {
    const auto line = lines.next();
    if (!line) throw tooShort(name, header);
    const auto words = splitBlanks(*line);
    if (words.empty()) continue;
    const std::string where = atLine(name, lines.number());
    if (words.size() != row_words)
      throw UserError(where, std::to_string(words.size()) + " numbers", std::to_string(row_words));
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto value = parseCell(words[words_before[axis]]);
      if (!value) throw UserError(where, "`" + std::string(words[words_before[axis]].substr(0, 40)) + "`", "a number");
      point[static_cast<Eigen::Index>(axis)] = *value;
    }
    cloud.points.push_back(point);
  }
  return cloud;
}

/// `by_field`: structure of arrays, as in a compressed file; otherwise point by point.
Vertices binaryPoints(const PcdHeader& header, std::string_view bytes, bool by_field, const std::string& name) {
  const auto columns = findCoordinates(header, name);
  std::size_t row = 0;
  std::array<std::size_t, 3> offsets{};
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (columns[axis] == i) offsets[axis] = row;
    row += header.fields[i].size();
  }
  if (header.points > bytes.size() / row) throw tooShort(name, header);
  Vertices cloud;
  cloud.points.resize(header.points);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BinaryNumber number = header.fields[columns[axis]].number;
    const char* begin = bytes.data() + (by_field ? offsets[axis] * header.points : offsets[axis]);
    const std::size_t step = by_field ? number.size : row;
    for (std::size_t i = 0; i < header.points; ++i)
      cloud.points[i][static_cast<Eigen::Index>(axis)] = readBinary(begin + i * step, number, false);
  }
  return cloud;
}

Vertices compressedPoints(const PcdHeader& header, std::string_view bytes, const std::string& name) {
  if (bytes.size() < 8) throw tooShort(name, header);
  std::uint32_t packed = 0, plain = 0;
  std::memcpy(&packed, bytes.data(), 4);
  std::memcpy(&plain, bytes.data() + 4, 4);
  // Three bytes of LZF decompress to at most 264: a larger size is invalid and would waste memory.
  if (packed > bytes.size() - 8 || plain / 88 > packed) throw tooShort(name, header);
  const auto unpacked = decompressLzf(bytes.substr(8, packed), plain);
  if (!unpacked) throw UserError(name, "the compressed points are damaged", "a complete file");
  return binaryPoints(header, *unpacked, true, name);
}

}  // namespace

Vertices parsePcd(std::string_view content, const std::string& name) {
  HeaderLines lines(content);
  const PcdHeader header = readPcdHeader(lines, name);
  if (header.data == "ascii") return asciiPoints(header, lines, name);
  if (header.data == "binary") return binaryPoints(header, lines.rest(), false, name);
  return compressedPoints(header, lines.rest(), name);
}

}  // namespace urban_nav_core::cloud_formats
