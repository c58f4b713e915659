// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/format_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace urban_nav_core {

std::string formatNumber(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  const double magnitude = std::floor(std::log10(std::abs(value)));
  char text[64];
  if (magnitude < -5 || magnitude > 11) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
  }
  const int decimals = std::max(0, digits - 1 - static_cast<int>(magnitude));
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  std::string shown = text;
  if (shown.find('.') != std::string::npos) {
    shown.erase(shown.find_last_not_of('0') + 1);
    if (shown.back() == '.') shown.pop_back();
  }
  return shown == "-0" ? "0" : shown;
}

}  // namespace urban_nav_core
