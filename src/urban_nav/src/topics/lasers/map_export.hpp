// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "laser_mapper/georeference/georeference.hpp"
#include "laser_mapper/laser_map.hpp"
#include "map/point_attributes.hpp"
#include "topics/lasers/map_crs.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Files of a point map by format; an empty path is not written.
struct MapFilePaths {
  std::string ply, pcd, las;
  std::string grid;                                             ///< YAML of map_server; the PGM is written next to it
  std::string ortho;                                            ///< PNG; its world file is written next to it
  std::string mesh = {};                                        ///< PLY with vertices and faces
  std::string geotiff = {};                                     ///< the picture of `ortho`
  std::string elevation = {}, slope = {}, traversability = {};  ///< GeoTIFF
  std::string octomap = {};                                     ///< .bt, in the frame map
  std::string crs = {};                                         ///< coordinate system, for MapCrs; empty: the frame map
  std::string control = {};                                     ///< CSV of surveyed points, for MapCrs

  std::vector<const std::string*> all() const {
    return {&ply, &pcd, &las, &grid, &ortho, &mesh, &geotiff, &elevation, &slope, &traversability, &octomap};
  }
  bool any() const { return needColour() || needGroundFiles() || !octomap.empty(); }
  bool needColour() const { return !(ply + pcd + las + ortho + mesh + geotiff).empty(); }
  bool needGroundFiles() const { return !(grid + elevation + slope + traversability).empty(); }
  /// Returns whether there is a file whose coordinates `crs` sets.
  bool areInCrs() const { return !(las + grid + ortho + mesh + geotiff + elevation + slope + traversability).empty(); }
  bool needGround() const { return needGroundFiles() || !las.empty(); }
};

/// Returns the attributes that another stage adds to the points of a map; nullopt: none. `first`: the first session of
/// the map.
using AttributeSource = std::function<std::optional<PointAttributes>(urban_nav_store::Store& store,
                                                                     const urban_nav_store::SessionId& first)>;

/// Result of exportMap().
struct ExportedMap {
  std::size_t points = 0;
  std::vector<std::string> files;
  std::optional<laser_mapper::GeoReference> reference;  ///< with MapFilePaths::crs
  int epsg = 0;
  std::string crs;  ///< for the user
  std::vector<MapCrs::ControlError> control;
};

/// Returns whether a store holds a map of laser points of one of these sessions.
bool holdsMap(urban_nav_store::Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map);

/// Writes the stored map of laser points of sessions in one map; the PLY file is identical to that of `map`.
/// `memory_mb`: for decoded images. `attributes`: of further stages. Throws DataError if the store has no such map.
ExportedMap exportMap(urban_nav_store::Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map,
                      const MapFilePaths& paths, double memory_mb, const AttributeSource& attributes = {});

/// Calls `take` for the tiles of the map of laser points of sessions in one map, in their order, with the colours of
/// map.ply; not at all if the store has no such map. `memory_mb`: for decoded images.
void forEachMapTile(urban_nav_store::Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map,
                    double memory_mb, const std::function<void(const std::vector<laser_mapper::MapPoint>&)>& take);

/// Writes the points of forEachMapTile() to `into`, another store, as tiles of all levels of detail.
void writeMapTiles(urban_nav_store::Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map,
                   double memory_mb, urban_nav_store::Store& into);

/// Returns `path` with another extension, which begins with a point.
std::string withExtension(const std::string& path, const std::string& extension);

}  // namespace urban_nav
