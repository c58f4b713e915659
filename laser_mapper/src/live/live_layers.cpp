// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_layers.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include "laser_mapper/layers/height_model.hpp"

namespace laser_mapper {

namespace {

constexpr std::int8_t kUnknownCell = -1;

std::vector<std::int8_t> toOccupancy(const OccupancyGrid& grid, std::size_t cells) {
  std::vector<std::int8_t> occupancy(cells, kUnknownCell);
  for (std::size_t i = 0; i < cells; ++i) {
    if (grid.state(i) == OccupancyGrid::State::Obstacle) occupancy[i] = 100;
    if (grid.state(i) == OccupancyGrid::State::Free) occupancy[i] = 0;
  }
  return occupancy;
}

std::vector<std::int8_t> toCosts(const Raster& traversability) {
  std::vector<std::int8_t> cost;
  cost.reserve(traversability.values.size());
  for (const float value : traversability.values)
    cost.push_back(value == kNoValue ? kUnknownCell : static_cast<std::int8_t>(std::lround(100.0F * (1.0F - value))));
  return cost;
}

}  // namespace

LiveLayers makeLiveLayers(const ForEachPart& parts, const std::vector<urban_nav_core::Vector3d>& path,
                          const BeamOrigin& origin) {
  GroundGrid ground({}, path);
  parts([&](const std::vector<MapPoint>& points) { ground.addSurface(points); });
  ground.find();
  OccupancyGrid grid(ground);
  HeightModel heights(ground);
  parts([&](const std::vector<MapPoint>& points) {
    grid.addBeams(points, origin);
    heights.add(points);
  });
  LiveLayers layers;
  layers.elevation = heights.elevation();
  layers.terrain = terrainLayers(layers.elevation, {});
  layers.occupancy = toOccupancy(grid, ground.size());
  layers.traverse_cost = toCosts(layers.terrain.traversability);
  return layers;
}

std::vector<urban_nav_core::PcdField> terrainFields() {
  return {{"x"}, {"y"}, {"z"}, {"slope"}, {"step"}, {"roughness"}, {"traversability"}};
}

std::string terrainPoints(const LiveLayers& layers) {
  const Raster& cells = layers.elevation;
  const TerrainLayers& terrain = layers.terrain;
  std::string bytes;
  const auto append = [&bytes](double value) {
    const auto number = static_cast<float>(value);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  for (int v = 0; v < cells.height; ++v)
    for (int u = 0; u < cells.width; ++u) {
      if (!cells.isKnown(u, v)) continue;
      append(cells.x0 + (u + 0.5) * cells.cell);
      append(cells.y0 + (v + 0.5) * cells.cell);
      append(static_cast<double>(cells.values[cells.at(u, v)]));
      for (const Raster* layer : {&terrain.slope, &terrain.step, &terrain.roughness, &terrain.traversability})
        append(layer->isKnown(u, v) ? static_cast<double>(layer->values[cells.at(u, v)])
                                    : std::numeric_limits<double>::quiet_NaN());
    }
  return bytes;
}

}  // namespace laser_mapper
