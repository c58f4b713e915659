// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/layers/height_model.hpp"

#include <algorithm>

namespace laser_mapper {

namespace {

constexpr std::uint32_t kFewestAbove = 2;  // points: a single one is not an obstacle

}  // namespace

void HeightModel::add(const std::vector<MapPoint>& points) {
  const auto tallest = static_cast<float>(ground_.model().robot_height);
  const auto step = static_cast<float>(ground_.model().obstacle_height);
  for (const MapPoint& point : points) {
    const auto at = ground_.index(point.p.x(), point.p.y());
    if (!at) continue;
    const float ground = ground_.ground(*at);
    if (point.p.z() - ground > tallest) continue;
    Cell& cell = cells_[*at];
    if (point.p.z() - *ground_.lowest(*at) <= step) {
      cell.sum += static_cast<double>(point.p.z() - ground);
      ++cell.near;
      continue;
    }
    cell.highest = cell.above == 0 ? point.p.z() : std::max(cell.highest, point.p.z());
    ++cell.above;
  }
}

Raster HeightModel::elevation() const {
  Raster raster;
  raster.width = ground_.width();
  raster.height = ground_.height();
  raster.x0 = ground_.x0();
  raster.y0 = ground_.y0();
  raster.cell = ground_.model().resolution;
  raster.values.assign(cells_.size(), kNoValue);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    if (cell.above >= kFewestAbove) raster.values[i] = cell.highest;
    else if (cell.near > 0) raster.values[i] = static_cast<float>(ground_.ground(i) + cell.sum / cell.near);
  }
  return raster;
}

}  // namespace laser_mapper
