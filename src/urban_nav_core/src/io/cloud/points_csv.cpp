// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <limits>
#include <vector>

#include "formats.hpp"
#include "urban_nav_core/io/column_names.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::cloud_formats {
namespace {

/// Columns of x, y, z, and their units in m.
struct Axes {
  std::array<std::size_t, 3> columns = {0, 1, 2};
  std::array<double, 3> units = {1.0, 1.0, 1.0};
};

Axes findAxes(const TextTable& table) {
  const std::vector<std::string>& header = table.header();
  Axes axes;
  if (header.empty()) return axes;
  constexpr std::array<Quantity, 3> kQuantities = {Quantity::X, Quantity::Y, Quantity::Z};
  for (std::size_t i = 0; i < kQuantities.size(); ++i) {
    const auto found = findColumn(header, kQuantities[i]);
    if (!found && table.headerIsComment()) return {};
    if (!found)
      throw UserError(table.whereHeader(), std::string("no column ") + "xyz"[i] + " in the header " + joined(header),
                      "PLY, PCD, or CSV with the columns x, y, z");
    axes.columns[i] = *found;
    axes.units[i] = readUnit(header[*found]).value_or(1.0);
  }
  return axes;
}

[[noreturn]] void refuseCount(const std::string& name, std::size_t promised, std::size_t found) {
  throw UserError(name,
                  "ends after " + std::to_string(found) + " points, the header declares " + std::to_string(promised),
                  "a complete file");
}

}  // namespace

Vertices parsePoints(std::string_view content, const std::string& name) {
  const TextTable table(content, name);
  const Axes axes = findAxes(table);
  Vertices cloud;
  cloud.points.reserve(countLines(content) + 1);
  std::size_t promised = 0;  // from the point counts that some programs write above the points
  table.forEachRow([&](const TableRow& row) {
    if (const auto count = row.cells.size() == 1 ? parseInteger(row.cells.front()) : std::nullopt;
        count && *count >= 0) {
      if (promised > cloud.points.size()) return refuseCount(name, promised, cloud.points.size());
      promised = cloud.points.size() + static_cast<std::size_t>(*count);
      return;
    }
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t column = axes.columns[axis];
      if (column >= row.cells.size())
        throw UserError(table.where(row), std::to_string(row.cells.size()) + " columns",
                        "at least " + std::to_string(column + 1));
      const std::string_view cell = row.cells[column];
      const bool is_left_empty = cell.empty() && row.cells.size() == table.width();  // NaN in the output of some
                                                                                     // programs
      const auto value = is_left_empty ? std::numeric_limits<double>::quiet_NaN() : parseCell(cell);
      if (!value) throw UserError(table.where(row), quotedCell(cell), "a number");
      point[static_cast<Eigen::Index>(axis)] = axes.units[axis] * *value;
    }
    cloud.points.push_back(point);
  });
  if (promised > cloud.points.size()) refuseCount(name, promised, cloud.points.size());
  return cloud;
}

}  // namespace urban_nav_core::cloud_formats
