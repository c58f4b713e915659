// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/row_match.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "urban_nav_core/image/patch.hpp"

namespace urban_nav_core {

namespace {

constexpr double kUniqueness = 0.85;     // ratio of the best to the second best more than two pixels away
constexpr double kAcceptedShare = 0.75;  // of the patch's contrast
constexpr int kLongestRow = 1024;        // disparities of one search

struct Best {
  int sad = std::numeric_limits<int>::max(), second = std::numeric_limits<int>::max(), u = 0;
};

/// Returns the best position of a patch on row v between two columns, and the best one more than two pixels from it.
Best searchRow(const SadPatch& patch, const ImageView& image, int from, int to, int v) {
  Best best;
  std::array<int, kLongestRow> sads;
  to = std::min(to, from + kLongestRow - 1);
  meanRemovedSads(patch, image, from, v, to - from + 1, sads.data());
  for (int u = from; u <= to; ++u) {
    const int sad = sads[static_cast<std::size_t>(u - from)];
    if (sad >= best.sad) continue;
    best.sad = sad;
    best.u = u;
  }
  for (int u = from; u <= to; ++u)
    if (std::abs(u - best.u) > 2) best.second = std::min(best.second, sads[static_cast<std::size_t>(u - from)]);
  return best;
}

}  // namespace

std::optional<int> findDisparity(const ImageView& left, const ImageView& right, int u, int v, int lowest, int highest,
                                 int row_offset) {
  const int row = v + row_offset;
  if (!sadFits(left, u, v) || !sadFits(right, right.width / 2, row)) return std::nullopt;
  const SadPatch patch = sadPatch(left, u, v);
  int contrast = 0;
  for (const std::int16_t value : patch.value) contrast += std::abs(value);
  const int from = std::max(4, u - highest), to = std::min(right.width - 4, u - lowest);
  if (to <= from) return std::nullopt;
  const Best forth = searchRow(patch, right, from, to, row);
  if (forth.sad > kAcceptedShare * contrast || forth.sad > kUniqueness * forth.second) return std::nullopt;
  const Best back = searchRow(sadPatch(right, forth.u, row), left, std::max(4, forth.u + lowest),
                              std::min(left.width - 4, forth.u + highest), v);
  if (std::abs(back.u - u) > 1) return std::nullopt;
  return u - forth.u;
}

}  // namespace urban_nav_core
