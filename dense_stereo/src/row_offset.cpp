// SPDX-License-Identifier: BSD-3-Clause
#include "row_offset.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace dense_stereo {

namespace {

constexpr int kGrid = 12;        // blocks along each side of the image
constexpr int kBlockRadius = 4;  // px
constexpr int kFarthest = 8;     // rows
constexpr int kLeastBlocks = 20;
constexpr int kLeastSlope = 8;  // grey levels for two rows

using Block = std::array<int, (2 * kBlockRadius + 1) * (2 * kBlockRadius + 1)>;

/// Returns the pixels around (u, v), with their mean removed.
Block blockAt(const Padded<std::uint8_t>& image, int u, int v) {
  Block block{};
  int sum = 0;
  std::size_t i = 0;
  for (int dv = -kBlockRadius; dv <= kBlockRadius; ++dv)
    for (int du = -kBlockRadius; du <= kBlockRadius; ++du) sum += block[i++] = image.row(v + dv)[u + du];
  const int mean = sum / static_cast<int>(block.size());
  for (int& pixel : block) pixel -= mean;
  return block;
}

int computeDistance(const Block& a, const Block& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum;
}

/// Returns the texture across rows, which is required to distinguish rows.
int rowTexture(const Padded<std::uint8_t>& image, int u, int v) {
  int sum = 0;
  for (int dv = -kBlockRadius; dv <= kBlockRadius; ++dv)
    for (int du = -kBlockRadius; du <= kBlockRadius; ++du)
      sum += std::abs(image.row(v + dv + 1)[u + du] - image.row(v + dv - 1)[u + du]);
  return sum;
}

/// Returns the row in which a block is matched best, relative to its own; `farthest + 1` without a clear minimum.
int bestRow(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right, int u, int v, int disparities) {
  const Block block = blockAt(left, u, v);
  std::array<int, 2 * kFarthest + 1> costs{};
  for (int k = -kFarthest; k <= kFarthest; ++k) {
    int& cost = costs[static_cast<std::size_t>(k + kFarthest)];
    cost = 1 << 30;
    for (int d = 0; d < disparities && u - d >= kBlockRadius; ++d)
      cost = std::min(cost, computeDistance(block, blockAt(right, u - d, v + k)));
  }
  const auto best = std::min_element(costs.begin(), costs.end());
  const int row = static_cast<int>(best - costs.begin()) - kFarthest;
  for (int k = -kFarthest; k <= kFarthest; ++k)
    if (std::abs(k - row) > 1 && 4 * costs[static_cast<std::size_t>(k + kFarthest)] < 5 * *best) return kFarthest + 1;
  return row;
}

}  // namespace

std::optional<double> matchedRowOffset(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right,
                                       const DisparityImage& image) {
  std::int64_t moment = 0, information = 0, count = 0;
  for (int v = 2; v + 2 < image.height; v += 3)
    for (int u = v % 4; u < image.width; u += 4) {
      if (!image.isValid(u, v)) continue;
      const int column = u - static_cast<int>(std::lround(image.disparity[image.index(u, v)]));
      if (column < 0) continue;
      const int slope = right.row(v + 1)[column] - right.row(v - 1)[column];
      const int difference = left.row(v)[u] - right.row(v)[column];
      // Pixels whose difference exceeds what the slope explains belong to different points.
      if (std::abs(slope) < kLeastSlope || std::abs(difference) > std::abs(slope)) continue;
      moment += 2 * slope * difference;
      information += slope * slope;
      ++count;
    }
  if (count < 1000) return std::nullopt;
  return static_cast<double>(moment) / static_cast<double>(information);
}

std::optional<int> searchedRowOffset(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right,
                                     int disparities) {
  std::array<int, 2 * kFarthest + 1> votes{};
  int all = 0;
  const int margin = kFarthest + kBlockRadius + 2;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const int u = left.width() * (2 * j + 1) / (2 * kGrid), v = left.height() * (2 * i + 1) / (2 * kGrid);
      if (v < margin || v >= left.height() - margin || u < margin || u >= left.width() - margin) continue;
      if (rowTexture(left, u, v) < 81 * kLeastSlope) continue;
      const int row = bestRow(left, right, u, v, disparities);
      if (row > kFarthest) continue;
      ++votes[static_cast<std::size_t>(row + kFarthest)];
      ++all;
    }
  const auto most = std::max_element(votes.begin(), votes.end());
  if (all < kLeastBlocks || 2 * *most < all) return std::nullopt;
  return static_cast<int>(most - votes.begin()) - kFarthest;
}

}  // namespace dense_stereo
