// SPDX-License-Identifier: BSD-3-Clause
#include "paper/log_filter.hpp"

#include <algorithm>

#include "sgm/descriptors.hpp"

namespace dense_stereo {

void LogFilter::apply(const Padded<std::uint8_t>& image, Padded<std::uint8_t>& filtered) {
  constexpr int kMargin = 8;
  const int width = image.width(), height = image.height();
  smooth_.resize(width, height);
  filtered.resize(width, height);
  std::vector<std::uint16_t>& down = column_;
  down.resize(static_cast<std::size_t>(width + 2 * kMargin));
  for (int v = 0; v < height; ++v) {
    const std::uint8_t* rows[5];
    for (int k = 0; k < 5; ++k) rows[k] = image.clampedRow(v + k - 2);
    for (int u = -kMargin; u < width + kMargin; ++u)
      down[static_cast<std::size_t>(u + kMargin)] =
          static_cast<std::uint16_t>(rows[0][u] + rows[4][u] + 4 * (rows[1][u] + rows[3][u]) + 6 * rows[2][u]);
    std::uint16_t* out = smooth_.row(v);
    for (int u = -kMargin + 2; u < width + kMargin - 2; ++u) {
      const std::uint16_t* p = down.data() + u + kMargin;
      out[u] = static_cast<std::uint16_t>(p[-2] + p[2] + 4 * (p[-1] + p[1]) + 6 * p[0]);
    }
  }
  for (int v = 0; v < height; ++v) {
    const std::uint16_t* above = smooth_.clampedRow(v - 1);
    const std::uint16_t* here = smooth_.row(v);
    const std::uint16_t* below = smooth_.clampedRow(v + 1);
    std::uint8_t* out = filtered.row(v);
    for (int u = 0; u < width; ++u) {
      const int laplacian = above[u] + below[u] + here[u - 1] + here[u + 1] - 4 * here[u];
      out[u] = static_cast<std::uint8_t>(std::clamp(128 + laplacian / 64, 65, 191));
    }
  }
  extendRows(filtered);
}

}  // namespace dense_stereo
