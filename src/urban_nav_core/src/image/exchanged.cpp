// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/exchanged.hpp"

#include <algorithm>
#include <cstdlib>

namespace urban_nav_core {

namespace {

constexpr int kShrink = 4;        // columns
constexpr int kShrunkBlock = 12;  // shrunk columns
constexpr int kBlockRows = 4;
constexpr int kLongestReach = 200;  // shrunk columns

// Sums over `kShrink` adjacent pixels of a row from a shrunk column on: a cheap low-pass filter.
void shrinkRows(const ImageView& image, int v, int column, int count, int* out) {
  for (int r = 0; r < kBlockRows; ++r) {
    const std::uint8_t* p = image.row(v + 2 * r) + column * kShrink;
    for (int c = 0; c < count; ++c, p += kShrink) *out++ = p[0] + p[1] + p[2] + p[3];
  }
}

// Difference of two blocks whose rows are `stride` apart; mean-removed, hence independent of exposure.
int difference(const int* a, const int* b, int stride) {
  constexpr int kCount = kShrunkBlock * kBlockRows;
  int values[kCount];
  int sum = 0;
  for (int r = 0; r < kBlockRows; ++r)
    for (int c = 0; c < kShrunkBlock; ++c) {
      const int d = a[r * kShrunkBlock + c] - b[r * stride + c];
      values[r * kShrunkBlock + c] = d;
      sum += d;
    }
  const int mean = sum / kCount;
  int cost = 0;
  for (const int value : values) cost += std::abs(value - mean);
  return cost;
}

}  // namespace

bool looksExchanged(const ImageView& left, const ImageView& right) {
  const int columns = left.width / kShrink;
  const int reach = std::min(columns / 6, kLongestReach);
  if (columns < 4 * kShrunkBlock || left.height < 64) return false;
  int usual = 0, exchanged = 0;
  for (int i = 0; i < 6; ++i) {
    const int v = left.height / 8 + i * (left.height * 3 / 4) / 6;
    for (int j = 0; j < 6; ++j) {
      const int column = reach + j * (columns - 2 * reach - kShrunkBlock) / 5;
      const int stride = kShrunkBlock + 2 * reach;
      int here[kShrunkBlock * kBlockRows], there[(kShrunkBlock + 2 * kLongestReach) * kBlockRows],
          costs[2 * kLongestReach + 1] = {};
      shrinkRows(left, v, column, kShrunkBlock, here);
      shrinkRows(right, v, column - reach, stride, there);
      for (int shift = -reach; shift <= reach; ++shift)
        costs[shift + reach] = difference(here, there + reach - shift, stride);
      int* const end = costs + 2 * reach + 1;
      const int* best = std::min_element(costs, end);
      const int found = static_cast<int>(best - costs) - reach;
      const int opposite =
          found > 0 ? *std::min_element(costs, costs + reach + 1) : *std::min_element(costs + reach, end);
      const int worst = *std::max_element(costs, end);
      // Requires texture and a best shift that is clearly non-zero and clearly better than any of the other sign.
      if (worst < 40 * kShrunkBlock * kBlockRows || found == 0 || 3 * *best > 2 * opposite) continue;
      (found > 0 ? usual : exchanged)++;
    }
  }
  return exchanged >= 5 && exchanged > 4 * usual;
}

}  // namespace urban_nav_core
