// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/layers/raster.hpp"

#include <algorithm>

namespace laser_mapper {

Raster emptyLike(const Raster& raster) {
  Raster empty = raster;
  std::fill(empty.values.begin(), empty.values.end(), kNoValue);
  return empty;
}

Raster cropped(const Raster& raster, int margin) {
  int u0 = raster.width, u1 = -1, v0 = raster.height, v1 = -1;
  for (int v = 0; v < raster.height; ++v)
    for (int u = 0; u < raster.width; ++u) {
      if (!raster.isKnown(u, v)) continue;
      u0 = std::min(u0, u);
      u1 = std::max(u1, u);
      v0 = std::min(v0, v);
      v1 = std::max(v1, v);
    }
  if (u1 < 0) u0 = u1 = v0 = v1 = 0;
  u0 = std::max(0, u0 - margin);
  v0 = std::max(0, v0 - margin);
  u1 = std::min(raster.width - 1, u1 + margin);
  v1 = std::min(raster.height - 1, v1 + margin);
  Raster part;
  part.width = u1 - u0 + 1;
  part.height = v1 - v0 + 1;
  part.cell = raster.cell;
  part.x0 = raster.x0 + u0 * raster.cell;
  part.y0 = raster.y0 + v0 * raster.cell;
  for (int v = v0; v <= v1; ++v)
    for (int u = u0; u <= u1; ++u) part.values.push_back(raster.values[raster.at(u, v)]);
  return part;
}

}  // namespace laser_mapper
