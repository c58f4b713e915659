// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "urban_nav_core/image/patch.hpp"

namespace urban_nav_core {

namespace {

constexpr int kSize = PatchSource::kSize, kStride = PatchSource::kStride;
constexpr int kReach = 3;  // px: three standard deviations of the largest blur
constexpr double kLeastVariance = 0.02;

using Grid = std::array<float, static_cast<std::size_t>(kSize* kStride)>;

/// Convolves along rows (step 1) or columns (step stride); beyond the border the last pixel is repeated.
void spread(double variance, int step, Grid& grid) {
  if (!(variance > kLeastVariance)) return;
  std::array<float, 2 * kReach + 1> weight;
  float total = 0.0F;
  for (int k = -kReach; k <= kReach; ++k)
    total += weight[static_cast<std::size_t>(k + kReach)] = static_cast<float>(std::exp(-0.5 * k * k / variance));
  const int across = step == 1 ? kStride : 1;
  std::array<float, kSize> line;
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < kSize; ++j)
      line[static_cast<std::size_t>(j)] = grid[static_cast<std::size_t>(i * across + j * step)];
    for (int j = 0; j < kSize; ++j) {
      float sum = 0.0F;
      for (int k = -kReach; k <= kReach; ++k)
        sum += weight[static_cast<std::size_t>(k + kReach)] *
               line[static_cast<std::size_t>(std::clamp(j + k, 0, kSize - 1))];
      grid[static_cast<std::size_t>(i * across + j * step)] = sum / total;
    }
  }
}

}  // namespace

PatchSource blurred(const PatchSource& source, const Eigen::Vector2d& variance) {
  Grid grid;
  std::transform(source.pixels.begin(), source.pixels.end(), grid.begin(),
                 [](std::uint8_t pixel) { return static_cast<float>(pixel); });
  spread(std::min(variance.x(), kLargestBlur), 1, grid);
  spread(std::min(variance.y(), kLargestBlur), kStride, grid);
  PatchSource result;
  std::transform(grid.begin(), grid.end(), result.pixels.begin(),
                 [](float value) { return static_cast<std::uint8_t>(std::lround(value)); });
  return result;
}

Eigen::Vector2d displacement(const PatchTemplate& patch, const PatchTemplate& other) {
  Eigen::Vector2d along = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < patch.value.size(); ++i) {
    const double more = static_cast<double>(patch.value[i] - other.value[i]);
    along += more * Eigen::Vector2d(patch.filter_x[i], patch.filter_y[i]);
  }
  return patch.inverse_hessian * along;
}

}  // namespace urban_nav_core
