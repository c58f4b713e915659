// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/layers/height_model.hpp"

#include <algorithm>

namespace laser_mapper {

namespace {

constexpr std::uint16_t kFewestAbove = 2;  // points: a single one is not an obstacle
constexpr std::uint16_t kMostCounted = 65535;

}  // namespace

void HeightModel::add(const std::vector<MapPoint>& points) {
  const auto tallest = static_cast<float>(ground_.model().robot_height);
  const auto step = static_cast<float>(ground_.model().obstacle_height);
  for (const MapPoint& point : points) {
    const auto at = ground_.index(point.p.x(), point.p.y());
    if (!at) continue;
    if (point.p.z() - ground_.ground(*at) > tallest) continue;
    Cell& cell = cells_[*at];
    const float above_lowest = point.p.z() - *ground_.lowest(*at);
    if (above_lowest > step) {
      cell.highest = cell.above == 0 ? point.p.z() : std::max(cell.highest, point.p.z());
      if (cell.above < kMostCounted) ++cell.above;
    } else if (cell.near < kMostCounted) {
      cell.sum += above_lowest;
      ++cell.near;
    }
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
    else if (cell.near > 0) raster.values[i] = *ground_.lowest(i) + cell.sum / static_cast<float>(cell.near);
  }
  return raster;
}

}  // namespace laser_mapper
