// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/cloud_columns.hpp"

#include <algorithm>

#include "formats.hpp"
#include "urban_nav_core/io/column_names.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

/// Finds axes in all spellings of x, y, z, and other columns by their exact names.
std::optional<std::size_t> findWanted(const std::vector<std::string>& header, const std::string& wanted) {
  const auto exact = std::find(header.begin(), header.end(), wanted);
  if (exact != header.end()) return static_cast<std::size_t>(exact - header.begin());
  const auto quantity = wanted.size() == 1 ? readQuantity(wanted) : std::nullopt;
  if (quantity) return findColumn(header, *quantity);
  const auto found = std::find_if(header.begin(), header.end(),
                                  [&](const std::string& name) { return plainName(name) == plainName(wanted); });
  if (found == header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.begin());
}

NumberColumns parseTextColumns(std::string_view content, const std::string& name,
                               const std::vector<std::string>& wanted) {
  TextTable table(content, name);
  table.requireHeader();
  NumberColumns columns(wanted.size());
  std::vector<std::size_t> places(wanted.size());
  std::vector<double> units(wanted.size(), 1.0);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto found = findWanted(table.header(), wanted[i]);
    if (!found) continue;
    places[i] = *found;
    units[i] = readUnit(table.header()[*found]).value_or(1.0);
    columns[i].emplace().reserve(cloud_formats::countLines(content));
  }
  table.forEachRow([&](const TableRow& row) {
    if (row.cells.size() != table.header().size())
      throw UserError(table.where(row), std::to_string(row.cells.size()) + " cells",
                      std::to_string(table.header().size()) + ", as many as the header has");
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (!columns[i]) continue;
      const std::string_view cell = row.cells[places[i]];
      const auto value = parseCell(cell);
      if (!value) throw UserError(table.where(row), wanted[i] + " = " + quotedCell(cell), "a number");
      columns[i]->push_back(units[i] * *value);
    }
  });
  return columns;
}

}  // namespace

NumberColumns readCloudColumns(const std::string& path, const std::vector<std::string>& wanted) {
  return parseCloudColumns(readBytes(path), path, wanted);
}

NumberColumns parseCloudColumns(std::string_view content, const std::string& name,
                                const std::vector<std::string>& wanted) {
  std::string plain;
  if (cloud_formats::isGzip(content)) {
    plain = cloud_formats::gunzip(content, name);
    content = plain;
  }
  if (content.substr(0, 4) == "LASF") return cloud_formats::parseLasColumns(content, name, wanted);
  const std::string text = cloud_formats::decodeContent(content);
  if (!text.empty()) content = text;
  if (content.substr(0, 4) == "ply\n" || content.substr(0, 4) == "ply\r")
    return cloud_formats::parsePlyColumns(content, name, wanted);
  return parseTextColumns(content, name, wanted);
}

}  // namespace urban_nav_core
