// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/map_export.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/mesh/surface_mesh.hpp"
#include "laser_mapper/tiles/tile_store.hpp"
#include "topics/lasers/current_rendering.hpp"
#include "topics/lasers/files/ground_files.hpp"
#include "topics/lasers/files/map_axes.hpp"
#include "topics/lasers/files/mapped_sessions.hpp"
#include "topics/lasers/files/mesh_file.hpp"
#include "topics/lasers/files/octomap_export.hpp"
#include "topics/lasers/files/picture_files.hpp"
#include "topics/lasers/files/point_files.hpp"
#include "topics/lasers/map_colour.hpp"
#include "topics/lasers/map_crs.hpp"
#include "topics/lasers/sensor_counts.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using laser_mapper::LaserMap;
using laser_mapper::MapPoint;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

using ColouredTile = std::function<void(const laser_mapper::Tile& tile, const std::vector<MapPoint>& points)>;

void forEachColouredTile(const LaserMap& map, MapColours& colours, const ColouredTile& take) {
  map.forEachTile([&](const laser_mapper::Tile& tile, std::vector<MapPoint> points) {
    colours.colour(tile, points);
    take(tile, points);
  });
}

using MapTileOf =
    std::function<void(const LaserMap& map, const laser_mapper::Tile& tile, const std::vector<MapPoint>& points)>;

/// Renders the map anew if edits have moved its poses.
void forEachCurrentTile(Store& store, const std::vector<StoredTrajectory>& map, const MappedSessions& mapped,
                        double memory_mb, const MapTileOf& take) {
  if (mapped.sessions.empty()) return;
  CurrentRendering rendering(store, map);
  LaserMap laser_map(*mapped.parameters, rendering.store(), mapped.sessions);
  laser_map.load();
  MapColours colours(rendering.store(), laser_map, mapped.sessions, memory_mb, false);
  forEachColouredTile(laser_map, colours, [&](const laser_mapper::Tile& tile, const std::vector<MapPoint>& points) {
    take(laser_map, tile, points);
  });
}

/// Map, axes and ground that all files of a call share.
struct ExportScene {
  Store& store;
  const LaserMap& map;
  const MappedSessions& mapped;
  const MapAxes& axes;
  const laser_mapper::GroundGrid* ground;  ///< null if no file needs it
};

/// Writes the formats with coloured points. Returns the number of points; nullopt, without any file, if `more` are the
/// attributes of other points.
std::optional<std::size_t> writePoints(const MapFilePaths& paths, const ExportScene& scene, MapColours& colours,
                                       const std::optional<PointAttributes>& more) {
  std::optional<Orthophoto> ortho;
  if (!(paths.ortho + paths.geotiff).empty()) ortho.emplace(scene.axes, scene.mapped.path);
  std::optional<laser_mapper::SurfaceMesher> mesher;
  if (!paths.mesh.empty()) mesher.emplace(scene.mapped.parameters->voxel);
  PointFiles files(paths, scene.axes, scene.ground, sensorNames(scene.store, scene.mapped.sessions), more);
  MapPointsDigest digest;
  std::size_t written = 0;
  std::vector<MapPoint> placed;
  forEachColouredTile(scene.map, colours, [&](const laser_mapper::Tile& tile, const std::vector<MapPoint>& points) {
    if (more) digest.add(points);
    files.append(points);
    if (ortho) ortho->draw(scene.axes.place(points, placed));
    if (mesher) mesher->add(tile, points);
    written += points.size();
  });
  if (more && (digest.value() != more->digest || written != more->points)) return std::nullopt;
  files.commit();
  if (!paths.ortho.empty()) ortho->writePng(paths.ortho);
  if (!paths.geotiff.empty()) ortho->writeTiff(paths.geotiff);
  if (mesher) writeMesh(paths.mesh, mesher->finish(), scene.axes);
  return written;
}

/// Returns whether the attributes belong to the points of the map.
bool areOfMap(const PointAttributes& attributes, const LaserMap& map) {
  MapPointsDigest digest;
  std::size_t points = 0;
  map.forEachTile([&](const laser_mapper::Tile&, const std::vector<MapPoint>& tile) {
    digest.add(tile);
    points += tile.size();
  });
  return digest.value() == attributes.digest && points == attributes.points;
}

/// Writes the formats with coloured points and the attributes, if these belong to the map. They mostly do if the
/// colours are stored: then that is verified while the points are written, since a pass over them takes half of the
/// time.
std::size_t writeColoured(const MapFilePaths& paths, const ExportScene& scene, double memory_mb,
                          const AttributeSource& attributes) {
  MapColours colours(scene.store, scene.map, scene.mapped.sessions, memory_mb, false);
  std::optional<PointAttributes> more;
  if (attributes && !(paths.ply + paths.las).empty()) more = attributes(scene.store, scene.mapped.sessions.front().id);
  if (more && colours.areComputed() && !areOfMap(*more, scene.map)) more.reset();
  if (more)
    if (const auto written = writePoints(paths, scene, colours, more)) return *written;
  return *writePoints(paths, scene, colours, std::nullopt);
}

}  // namespace

std::string withExtension(const std::string& path, const std::string& extension) {
  return std::filesystem::path(path).replace_extension(extension).string();
}

bool holdsMap(Store& store, const std::vector<StoredTrajectory>& map) {
  return std::any_of(map.begin(), map.end(), [&](const StoredTrajectory& each) {
    return laser_mapper::storedMapParameters(store, each.session.id).has_value();
  });
}

void forEachMapTile(Store& store, const std::vector<StoredTrajectory>& map, double memory_mb,
                    const std::function<void(const std::vector<MapPoint>&)>& take) {
  forEachCurrentTile(
      store, map, mappedSessions(store, map), memory_mb,
      [&](const LaserMap&, const laser_mapper::Tile&, const std::vector<MapPoint>& points) { take(points); });
}

void writeMapTiles(Store& store, const std::vector<StoredTrajectory>& map, double memory_mb, Store& into) {
  const MappedSessions mapped = mappedSessions(store, map);
  std::optional<laser_mapper::TileWriter> tiles;
  forEachCurrentTile(
      store, map, mapped, memory_mb,
      [&](const LaserMap& laser_map, const laser_mapper::Tile& tile, const std::vector<MapPoint>& points) {
        if (!tiles)
          tiles.emplace(into, laser_mapper::tiledSessions(store, mapped.sessions, laser_map.passes()),
                        mapped.parameters->voxel);
        tiles->add(tile, points);
      });
  if (tiles) tiles->finish();
}

ExportedMap exportMap(Store& store, const std::vector<StoredTrajectory>& map, const MapFilePaths& paths,
                      double memory_mb, const AttributeSource& attributes) {
  const MappedSessions mapped = mappedSessions(store, map);
  if (mapped.sessions.empty())
    throw urban_nav_core::DataError(store.path(), "holds no map", "a store of map with stage lasers");
  CurrentRendering rendering(store, map);
  LaserMap laser_map(*mapped.parameters, rendering.store(), mapped.sessions);
  laser_map.load();
  ExportedMap result;
  std::optional<MapCrs> crs;
  if (!paths.crs.empty()) {
    crs.emplace(paths.crs, paths.control, store, map);
    result.reference = crs->reference();
    result.control = crs->control();
    result.epsg = crs->epsg();
    result.crs = crs->describe();
  }
  const MapAxes axes(crs ? &*crs : nullptr, mapped.path);
  std::optional<laser_mapper::GroundGrid> ground;
  if (paths.needGround()) ground.emplace(findGround(laser_map, mapped, axes));
  if (paths.needColour())
    result.points = writeColoured(paths, {rendering.store(), laser_map, mapped, axes, ground ? &*ground : nullptr},
                                  memory_mb, attributes);
  if (paths.needGroundFiles()) writeGroundFiles(paths, laser_map, mapped, axes, *ground);
  if (!paths.octomap.empty()) writeOctomap(paths.octomap, laser_map, mapped);
  for (const std::string* path : paths.all())
    if (!path->empty()) result.files.push_back(*path);
  return result;
}

}  // namespace urban_nav
