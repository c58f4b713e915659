// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_core {

double travelledLength(const std::vector<Vector3d>& positions, double step) {
  if (positions.empty()) return 0.0;
  double length = 0.0;
  Vector3d last = positions.front();
  for (const Vector3d& position : positions) {
    const double moved = (position - last).norm();
    if (moved < step) continue;
    length += moved;
    last = position;
  }
  return length;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(
      std::min(static_cast<double>(values.size() - 1), std::floor(share * static_cast<double>(values.size()))));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace urban_nav_core
