// SPDX-License-Identifier: BSD-3-Clause
#include "distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "urban_nav_core/testing/bench_table.hpp"

namespace urban_nav_sim::bench {

using urban_nav_core::testing::cell;

double mean(const Values& values) {
  return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double spread(const Values& values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

double quantile(Values values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (place - static_cast<double>(low)) * (values[high] - values[low]);
}

double distributionDistance(const Values& simulated, const Values& real) {
  if (simulated.empty() || real.empty()) return std::numeric_limits<double>::infinity();
  // In 1D, the earth mover's distance is the area between the two distribution functions.
  Values a = simulated, b = real, all = simulated;
  all.insert(all.end(), real.begin(), real.end());
  for (Values* values : {&a, &b, &all}) std::sort(values->begin(), values->end());
  double area = 0.0;
  std::size_t i = 0, j = 0;
  for (std::size_t k = 0; k + 1 < all.size(); ++k) {
    while (i < a.size() && a[i] <= all[k]) ++i;
    while (j < b.size() && b[j] <= all[k]) ++j;
    const double difference =
        static_cast<double>(i) / static_cast<double>(a.size()) - static_cast<double>(j) / static_cast<double>(b.size());
    area += std::abs(difference) * (all[k + 1] - all[k]);
  }
  return area > 0.0 ? area / spread(real) : 0.0;
}

std::string summary(const Values& values, int decimals) {
  return cell(quantile(values, 0.5), decimals) + " (" + cell(quantile(values, 0.1), decimals) + " ... " +
         cell(quantile(values, 0.9), decimals) + ")";
}

}  // namespace urban_nav_sim::bench
