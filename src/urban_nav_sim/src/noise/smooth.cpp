// SPDX-License-Identifier: BSD-3-Clause
#include "noise/smooth.hpp"

#include <array>
#include <cmath>

namespace urban_nav_sim {
namespace {

// The mean over a cell of the sum of the squared weights is 151 / 315.
const double kToUnitVariance = std::sqrt(315.0 / 151.0);

std::array<double, 4> cubicWeights(double f) {
  const double g = 1.0 - f;
  return {g * g * g / 6.0, (4.0 + f * f * (3.0 * f - 6.0)) / 6.0, (4.0 + g * g * (3.0 * g - 6.0)) / 6.0,
          f * f * f / 6.0};
}

std::uint64_t toCounter(std::int64_t cell) { return static_cast<std::uint64_t>(cell + (std::int64_t{1} << 31)); }

}  // namespace

double smoothNoise(const Noise& noise, double x) {
  const auto cell = static_cast<std::int64_t>(std::floor(x));
  const auto weights = cubicWeights(x - static_cast<double>(cell));
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * noise.normal(toCounter(cell - 1 + static_cast<int>(i)));
  return sum * kToUnitVariance;
}

double smoothNoise(const Noise& noise, double x, double y) {
  const auto column = static_cast<std::int64_t>(std::floor(x)), row = static_cast<std::int64_t>(std::floor(y));
  const auto across = cubicWeights(x - static_cast<double>(column)), up = cubicWeights(y - static_cast<double>(row));
  double sum = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    const std::uint64_t start = toCounter(row - 1 + static_cast<int>(j)) << 32;
    for (std::size_t i = 0; i < 4; ++i) {
      sum += up[j] * across[i] * noise.normal(start + toCounter(column - 1 + static_cast<int>(i)));
    }
  }
  return sum * kToUnitVariance * kToUnitVariance;
}

}  // namespace urban_nav_sim
