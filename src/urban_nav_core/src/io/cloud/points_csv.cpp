// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "formats.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::cloud_formats {
namespace {

std::vector<std::string_view> splitCells(std::string_view line) {
  for (const char separator : {',', ';'})
    if (line.find(separator) != std::string_view::npos) return splitAt(line, separator);
  return splitBlanks(line);
}

std::string lower(std::string_view text) {
  std::string word(text);
  word.erase(std::remove(word.begin(), word.end(), '"'), word.end());
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

std::array<std::size_t, 3> findColumns(const std::vector<std::string_view>& header, const std::string& where) {
  std::array<std::size_t, 3> columns{};
  const std::array<std::string, 3> names = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found =
        std::find_if(header.begin(), header.end(), [&](std::string_view cell) { return lower(cell) == names[axis]; });
    if (found == header.end())
      throw UserError(where, "no column " + names[axis], "PLY, PCD, or CSV with the columns x, y, z");
    columns[axis] = static_cast<std::size_t>(found - header.begin());
  }
  return columns;
}

/// Text that a person can read in an error.
std::string quoted(std::string_view text) {
  std::string shown(text.substr(0, 40));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return std::isprint(c) == 0; }, '?');
  return "`" + shown + "`";
}

[[noreturn]] void refuseCount(const std::string& name, std::size_t promised, std::size_t found) {
  throw UserError(name, "ends after " + std::to_string(found) + " points, and announces " + std::to_string(promised),
                  "a whole file");
}

}  // namespace

Vertices parsePoints(std::string_view content, const std::string& name) {
  Vertices cloud;
  std::optional<std::array<std::size_t, 3>> columns;
  std::size_t promised = 0;  // by the counts that some programs write above their points
  forEachLine(content, [&](std::string_view line, int number) {
    std::string_view text = trimmed(line);
    while (!text.empty() && text.front() == '/') text = trimmed(text.substr(1));  // CloudCompare: //X,Y,Z
    if (text.empty() || text.front() == '#') return;
    const std::vector<std::string_view> cells = splitCells(text);
    if (const auto count = cells.size() == 1 ? parseInteger(cells.front()) : std::nullopt; count && *count >= 0) {
      if (promised > cloud.points.size()) return refuseCount(name, promised, cloud.points.size());
      promised = cloud.points.size() + static_cast<std::size_t>(*count);
      return;
    }
    if (!columns) {
      const bool numbers = parseCoordinate(cells.front()).has_value();
      columns = numbers ? std::array<std::size_t, 3>{0, 1, 2} : findColumns(cells, atLine(name, number));
      if (!numbers) return;
    }
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t column = (*columns)[axis];
      if (column >= cells.size())
        throw UserError(atLine(name, number), std::to_string(cells.size()) + " columns",
                        "at least " + std::to_string(column + 1));
      const auto value = parseCoordinate(cells[column]);
      if (!value) throw UserError(atLine(name, number), quoted(cells[column]), "a number");
      point[static_cast<Eigen::Index>(axis)] = *value;
    }
    cloud.points.push_back(point);
  });
  if (promised > cloud.points.size()) refuseCount(name, promised, cloud.points.size());
  return cloud;
}

}  // namespace urban_nav_core::cloud_formats
