// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/export_options.hpp"

namespace urban_nav {

namespace {

std::vector<Option> mapOptions() {
  return {
      {"--ply", "FILE", "the map of laser points, identical to map.ply", false, false, {}},
      {"--pcd", "FILE", "the map of laser points for PCL", false, false, {}},
      {"--las", "FILE", "the map of laser points as LAS 1.4, point format 7", false, false, {}},
      {"--grid",
       "FILE.yaml",
       "obstacles and free space for map_server; the PGM is written next to it",
       false,
       false,
       {}},
      {"--ortho", "FILE.png", "the map from above; its world file is written next to it", false, false, {}},
      {"--geotiff",
       "FILE.tif",
       "the picture of --ortho as GeoTIFF, transparent where nothing was measured",
       false,
       false,
       {}},
      {"--elevation",
       "FILE.tif",
       "height of the ground and of objects on it, up to 1.5 m above, as GeoTIFF",
       false,
       false,
       {}},
      {"--slope", "FILE.tif", "slope of --elevation in deg as GeoTIFF", false, false, {}},
      {"--traversability",
       "FILE.tif",
       "0 to 1 by slope, steps and roughness of --elevation as GeoTIFF",
       false,
       false,
       {}},
      {"--octomap",
       "FILE.bt",
       "occupied and free space as an OctoMap of cubes of 0.1 m, in the frame map",
       false,
       false,
       {}},
      {"--mesh", "FILE.ply", "the surface of the map as coloured triangles", false, false, {}},
      {"--crs",
       "auto,EPSG:N,local",
       "coordinate system of --las, --geotiff, --elevation, --slope, --traversability, --grid, --ortho, --mesh and "
       "--gpkg, from GPS fixes or --control (default: local, the frame map)",
       false,
       false,
       {}},
      {"--control",
       "FILE.csv",
       "surveyed points in place of GPS fixes: name,x,y,z,map_x,map_y,map_z; with --crs EPSG:N, their system",
       false,
       false,
       {}}};
}

}  // namespace

std::vector<Option> exportOptions() {
  std::vector<Option> options = {
      {"STORE", "", "session.db of a map; it is only read", true, false, {}},
      {"--tum",
       "FILE",
       "base_link in map, a line per pose; maps that did not join go to FILE_2 and so on",
       false,
       false,
       {}},
      {"--kitti", "FILE", "the left camera relative to its first pose, a line per stereo frame", false, false, {}},
      {"--g2o", "FILE", "the pose graph: all nodes, accepted edges", false, false, {}}};
  const std::vector<Option> more = {
      {"--gpkg",
       "FILE",
       "trajectories, closures, coverage and quality of all sessions as layers of a GeoPackage",
       false,
       false,
       {}},
      {"--mcap",
       "FILE.mcap",
       "as map --mcap, for Foxglove; maps that did not join go to FILE_2 and so on",
       false,
       false,
       {}},
      {"--places",
       "DIR",
       "folder to write: places.csv with the pose of each place, their thumbnails, and the model of their words",
       false,
       false,
       {}},
      {"--results",
       "DIR",
       "folder to write: trajectories, covariances, closures.csv, graph.g2o and map.ply of all sessions, identical to "
       "the output of map",
       false,
       false,
       {}},
      {"--session", "ID", "only sessions whose id or name begins with ID (default: all)", false, true, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  for (const Option& option : mapOptions()) options.push_back(option);
  options.insert(options.end(), more.begin(), more.end());
  return options;
}

}  // namespace urban_nav
