// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "table/rows.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace segway_drivers {

void appendCell(std::string& cells, const std::string& text) {
  if (!cells.empty()) cells += ',';
  cells += text;
}

void appendCell(std::string& cells, double value) {
  appendCell(cells, std::isfinite(value) ? urban_nav_core::printNumber(value) : std::string());
}

void appendCell(std::string& cells, float value) {
  appendCell(cells, std::isfinite(value) ? urban_nav_core::printNumber(value) : std::string());
}

}  // namespace segway_drivers
