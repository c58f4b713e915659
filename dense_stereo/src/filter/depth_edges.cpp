// SPDX-License-Identifier: BSD-3-Clause
#include "filter/depth_edges.hpp"

#include <algorithm>
#include <cstdlib>

#include "sgm/bytes.hpp"
#include "sgm/semi_global.hpp"

namespace dense_stereo {

namespace {

constexpr int kLongestGap = 8;  // px

/// Returns whether disparities differ by more than one pixel, or half a pixel per step across a gap.
bool isDepthJump(int a, int b, int gap) { return 2 * std::abs(a - b) > std::max(2, gap); }

/// Marks jumps along one row.
void markAlong(const std::uint16_t* d, int width, std::uint8_t* marks) {
  int last = -1;
  for (int u = 0; u < width; ++u) {
    if (d[u] == Winners::kInvalid) continue;
    if (last >= 0 && u - last <= kLongestGap && isDepthJump(d[u], d[last], u - last)) marks[u] = marks[last] = 255;
    last = u;
  }
}

}  // namespace

void DepthEdges::mark(const Padded<std::uint16_t>& disparity, Padded<std::uint8_t>& edges) {
  const int width = disparity.width(), height = disparity.height();
  edges.resize(width, height);
  wide_.resize(width, height);
  edges.fill(0);
  last_.assign(static_cast<std::size_t>(width), Winners::kInvalid);
  age_.assign(static_cast<std::size_t>(width), 0);
  for (int v = 0; v < height; ++v) {
    const std::uint16_t* d = disparity.row(v);
    markAlong(d, width, edges.row(v));
    for (int u = 0; u < width; ++u) {
      const std::size_t i = static_cast<std::size_t>(u);
      age_[i] = static_cast<std::uint8_t>(std::min(age_[i] + 1, 255));
      if (d[u] == Winners::kInvalid) continue;
      if (last_[i] != Winners::kInvalid && age_[i] <= kLongestGap && isDepthJump(d[u], last_[i], age_[i]))
        edges.row(v)[u] = edges.row(v - age_[i])[u] = 255;
      last_[i] = d[u];
      age_[i] = 0;
    }
  }
  for (int v = 0; v < height; ++v) {
    const std::uint8_t* from = edges.row(v);
    for (int u = 0; u < width; u += 16) {
      Bytes sum = Bytes::load(from + u);
      for (int k = 1; k <= kRadius; ++k)
        sum = either(sum, either(Bytes::load(from + u - k), Bytes::load(from + u + k)));
      sum.store(wide_.row(v) + u);
    }
  }
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; u += 16) {
      Bytes sum = Bytes::load(wide_.row(v) + u);
      for (int k = 1; k <= kRadius; ++k)
        sum = either(sum, either(Bytes::load(wide_.clampedRow(v - k) + u), Bytes::load(wide_.clampedRow(v + k) + u)));
      sum.store(edges.row(v) + u);
    }
}

}  // namespace dense_stereo
