// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/files/ground_files.hpp"

#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include "laser_mapper/layers/height_model.hpp"
#include "laser_mapper/layers/terrain.hpp"
#include "laser_mapper/occupancy_grid.hpp"
#include "topics/lasers/files/geotiff.hpp"
#include "topics/lasers/files/picture_files.hpp"
#include "urban_nav_core/io/atomic_file.hpp"

namespace urban_nav {

using laser_mapper::GroundGrid;
using laser_mapper::LaserMap;
using laser_mapper::MapPoint;
using laser_mapper::Raster;
using urban_nav_core::Vector3d;

namespace {

/// Returns the placement of the grid in the frame map.
laser_mapper::GridPlacement placementInMap(const GroundGrid& ground, const MappedSessions& mapped,
                                           const MapAxes& axes) {
  laser_mapper::GridPlacement placement = localPlacement(ground);
  if (axes.areOfMap() || mapped.path.empty()) return placement;
  const double height = axes.place(mapped.path.front()).z();
  const Vector3d corner = axes.toMap({ground.x0(), ground.y0(), height});
  const Vector3d east = axes.toMap({ground.x0() + ground.width() * placement.resolution, ground.y0(), height}) - corner;
  placement.x = corner.x();
  placement.y = corner.y();
  placement.yaw = std::atan2(east.y(), east.x());
  placement.resolution = east.head<2>().norm() / ground.width();
  return placement;
}

void writeGrid(const std::string& path, const laser_mapper::OccupancyGrid& grid, const GroundGrid& ground,
               const MappedSessions& mapped, const MapAxes& axes) {
  const std::string pgm = withExtension(path, ".pgm");
  urban_nav_core::writeAtomically(pgm, laser_mapper::printPgm(grid.image(), ground.width(), ground.height()));
  const double edge = ground.model().resolution;
  if (!axes.areOfMap()) writeWorldFile(pgm, axes, edge, {ground.x0(), ground.y0() + edge * ground.height(), 0.0});
  urban_nav_core::writeAtomically(
      path, printGridYaml(placementInMap(ground, mapped, axes), std::filesystem::path(pgm).filename().string()));
}

void writeLayer(const std::string& path, const MapAxes& axes, const Raster& raster, double offset,
                const std::string& layer, const std::string& unit) {
  ImagePlacement placement{raster.width, raster.height, raster.x0 + axes.offset().x(),
                           raster.y0 + raster.height * raster.cell + axes.offset().y(), raster.cell};
  if (!axes.areOfMap()) {
    placement.epsg = axes.crs()->epsg();
    placement.crs = axes.crs()->name();
  }
  std::vector<float> rows;
  rows.reserve(raster.values.size());
  for (int v = raster.height - 1; v >= 0; --v)
    for (int u = 0; u < raster.width; ++u) {
      const float value = raster.values[raster.at(u, v)];
      rows.push_back(value == laser_mapper::kNoValue ? value : static_cast<float>(static_cast<double>(value) + offset));
    }
  writeGeoTiff(path, placement, rows, layer, unit);
}

void writeLayers(const MapFilePaths& paths, const MapAxes& axes, const laser_mapper::HeightModel& heights) {
  const Raster elevation = cropped(heights.elevation());
  if (!paths.elevation.empty()) writeLayer(paths.elevation, axes, elevation, axes.offset().z(), "elevation", "m");
  if ((paths.slope + paths.traversability).empty()) return;
  const laser_mapper::TerrainLayers layers = terrainLayers(elevation, {}, axes.scale());
  if (!paths.slope.empty()) writeLayer(paths.slope, axes, layers.slope, 0.0, "slope", "deg");
  if (!paths.traversability.empty())
    writeLayer(paths.traversability, axes, layers.traversability, 0.0, "traversability", "");
}

}  // namespace

GroundGrid findGround(const LaserMap& map, const MappedSessions& mapped, const MapAxes& axes) {
  laser_mapper::GridModel model;
  model.margin *= axes.scale();
  model.robot_radius *= axes.scale();
  GroundGrid ground(model, axes.place(mapped.path));
  std::vector<MapPoint> buffer;
  map.forEachTile([&](const laser_mapper::Tile&, const std::vector<MapPoint>& points) {
    ground.addSurface(axes.place(points, buffer));
  });
  ground.find();
  return ground;
}

void writeGroundFiles(const MapFilePaths& paths, const LaserMap& map, const MappedSessions& mapped, const MapAxes& axes,
                      const GroundGrid& ground) {
  std::optional<laser_mapper::OccupancyGrid> grid;
  if (!paths.grid.empty()) grid.emplace(ground);
  std::optional<laser_mapper::HeightModel> heights;
  if (!(paths.elevation + paths.slope + paths.traversability).empty()) heights.emplace(ground);
  std::vector<MapPoint> buffer;
  const auto origin = [&](const MapPoint& point) -> std::optional<Vector3d> {
    const auto p_map = beamOrigin(mapped, point);
    return p_map ? std::optional<Vector3d>(axes.place(*p_map)) : std::nullopt;
  };
  map.forEachTile([&](const laser_mapper::Tile&, const std::vector<MapPoint>& points) {
    const std::vector<MapPoint>& placed = axes.place(points, buffer);
    if (grid) grid->addBeams(placed, origin);
    if (heights) heights->add(placed);
  });
  if (grid) writeGrid(paths.grid, *grid, ground, mapped, axes);
  if (heights) writeLayers(paths, axes, *heights);
}

}  // namespace urban_nav
