// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/map_export.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_files.hpp"
#include "laser_mapper/map_picture.hpp"
#include "laser_mapper/mesh/surface_mesh.hpp"
#include "laser_mapper/occupancy_grid.hpp"
#include "laser_mapper/sensors.hpp"
#include "laser_mapper/tiles/tile_store.hpp"
#include "topics/lasers/current_rendering.hpp"
#include "topics/lasers/map_colour.hpp"
#include "topics/lasers/map_crs.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using laser_mapper::LaserMap;
using laser_mapper::MapPoint;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

constexpr double kOrthoMargin = 30.0;  // m around the path, before cropping
constexpr int kLongestOrtho = 16000;   // px
constexpr StampNs kLongestPoseGap = 500'000'000;
constexpr const char* kLocalSystem =
    R"(LOCAL_CS["map of urban_nav",LOCAL_DATUM["first pose",0],UNIT["metre",1],AXIS["x",OTHER],AXIS["y",OTHER],AXIS["z",UP]])";

/// Sessions of a map with points.
struct MappedSessions {
  std::vector<std::unique_ptr<Trajectory>> trajectories;
  std::vector<laser_mapper::MappedSession> sessions;
  std::vector<std::map<std::uint8_t, Pose>> sensors;  ///< extrinsics by their ids
  std::vector<Vector3d> path;
  std::optional<laser_mapper::Parameters> parameters;
};

MappedSessions mappedSessions(Store& store, const std::vector<StoredTrajectory>& map) {
  MappedSessions result;
  for (const StoredTrajectory& each : map) {
    const auto parameters = laser_mapper::storedMapParameters(store, each.session.id);
    if (!parameters || each.T_map_base.empty()) continue;
    result.parameters = parameters;
    result.trajectories.push_back(std::make_unique<Trajectory>(each.T_map_base));
    result.sessions.push_back({each.session.id, result.trajectories.back().get(), nullptr});
    result.sensors.push_back(laser_mapper::sensorPlaces(store, each.session.id));
    for (const urban_nav_core::StampedPose& pose : each.T_map_base) result.path.push_back(pose.pose.t());
  }
  return result;
}

/// Returns the position of the sensor of a point; nullopt for dense stereo, whose lines of sight do not imply free
/// space.
std::optional<Vector3d> beamOrigin(const MappedSessions& mapped, const MapPoint& point) {
  for (std::size_t s = 0; s < mapped.sessions.size(); ++s) {
    const auto place = mapped.sensors[s].find(point.laser);
    if (place == mapped.sensors[s].end()) continue;
    if (const auto T_map_base = mapped.trajectories[s]->at(point.stamp, kLongestPoseGap))
      return *T_map_base * place->second.t();
  }
  return std::nullopt;
}

std::vector<laser_mapper::SensorName> mappedSensors(Store& store, const MappedSessions& mapped) {
  std::vector<urban_nav_store::SessionId> ids;
  for (const laser_mapper::MappedSession& session : mapped.sessions) ids.push_back(session.id);
  return laser_mapper::storedSensors(store, ids);
}

/// Writer of the formats with a record for each point.
class PointFiles {
 public:
  /// `crs`: of the LAS file; null: the frame map. Must outlive it. `more`: attributes of all points; nullopt: none.
  PointFiles(const MapFilePaths& paths, const MapCrs* crs, const std::vector<laser_mapper::SensorName>& sensors,
             std::optional<PointAttributes> more)
      : crs_(crs), more_(std::move(more)) {
    std::vector<urban_nav_core::LasAttribute> attributes = laser_mapper::mapLasAttributes();
    if (more_) attributes.push_back(more_->las);
    if (!paths.ply.empty()) ply_.emplace(paths.ply, plyLayout(sensors));
    if (!paths.pcd.empty()) pcd_.emplace(paths.pcd, laser_mapper::mapPcdFields());
    if (!paths.las.empty()) las_.emplace(paths.las, attributes, crs ? crs->wkt() : kLocalSystem);
  }
  void append(const std::vector<MapPoint>& points) {
    for (const MapPoint& point : points) {
      if (ply_) appendPly(point);
      if (pcd_) appendBytes(*pcd_, laser_mapper::appendPcdPoint, point);
      bytes_.clear();
      if (las_) laser_mapper::appendLasAttributes(bytes_, point);
      if (las_) appendLas(point);
      ++next_;
    }
  }
  void commit() {
    if (ply_) ply_->commit();
    if (pcd_) pcd_->commit();
    if (las_) las_->commit();
  }

 private:
  template <typename Writer>
  void appendBytes(Writer& writer, void (*print)(std::string&, const MapPoint&), const MapPoint& point) {
    bytes_.clear();
    print(bytes_, point);
    writer.append(bytes_);
  }

  urban_nav_core::PlyLayout plyLayout(const std::vector<laser_mapper::SensorName>& sensors) const {
    urban_nav_core::PlyLayout layout = laser_mapper::mapLayout(sensors);
    if (!more_) return layout;
    layout.properties.insert(layout.properties.end(), more_->ply.properties.begin(), more_->ply.properties.end());
    layout.comments.insert(layout.comments.end(), more_->ply.comments.begin(), more_->ply.comments.end());
    return layout;
  }

  void appendPly(const MapPoint& point) {
    bytes_.clear();
    laser_mapper::appendVertex(bytes_, point);
    if (more_) more_->append_ply(next_, bytes_);
    ply_->append(bytes_);
  }

  void appendLas(const MapPoint& point) {
    urban_nav_core::LasPoint result = laser_mapper::lasPoint(point);
    if (more_) {
      result.classification = more_->las_classification(next_);
      more_->append_las(next_, bytes_);
    }
    if (crs_ != nullptr) result.p = crs_->project(result.p);
    las_->append(result, bytes_);
  }

  const MapCrs* crs_;
  const std::optional<PointAttributes> more_;
  std::size_t next_ = 0;  // number of the next point
  std::optional<urban_nav_core::PlyWriter> ply_;
  std::optional<urban_nav_core::PcdWriter> pcd_;
  std::optional<urban_nav_core::LasWriter> las_;
  std::string bytes_;
};

/// Writes the picture and its world file: pixel size, and the centre of the first pixel (ESRI world file).
void writeOrtho(const std::string& path, const laser_mapper::MapView& view, const laser_mapper::MapPicture& drawn) {
  const laser_mapper::PictureBox box = drawn.shownBox();
  const urban_nav_registration::Picture picture = drawn.finish(box);
  const cv::Mat image(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.bgr.data()));
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", image, bytes)) throw urban_nav_core::DataError(path, "cannot be encoded", "");
  const Vector3d first =
      view.T_camera_map.inverse() * Vector3d((0.5 + box.u0 - 0.5 * view.width) / view.px_per_m,
                                             (0.5 + box.v0 - 0.5 * view.height) / view.px_per_m, 0.0);
  std::string world;
  for (const double value : {1.0 / view.px_per_m, 0.0, 0.0, -1.0 / view.px_per_m, first.x(), first.y()})
    world += urban_nav_core::printNumber(value) + "\n";
  urban_nav_core::writeAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  urban_nav_core::writeAtomically(withExtension(path, ".pgw"), world);
}

void writeGrid(const std::string& path, const LaserMap& map, const MappedSessions& mapped) {
  const laser_mapper::GridModel model;
  laser_mapper::OccupancyGrid grid(model, mapped.path);
  map.forEachTile([&](const laser_mapper::Tile&, const std::vector<MapPoint>& points) { grid.addSurface(points); });
  grid.findGround();
  map.forEachTile([&](const laser_mapper::Tile&, const std::vector<MapPoint>& points) {
    grid.addBeams(points, [&](const MapPoint& point) { return beamOrigin(mapped, point); });
  });
  const std::string pgm = withExtension(path, ".pgm");
  urban_nav_core::writeAtomically(pgm, laser_mapper::printPgm(grid.image(), grid.width(), grid.height()));
  urban_nav_core::writeAtomically(
      path, laser_mapper::printGridYaml(grid, model, std::filesystem::path(pgm).filename().string()));
}

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

/// Writes the formats with coloured points. Returns the number of points; nullopt, without any file, if `more` are the
/// attributes of other points.
std::optional<std::size_t> writePoints(const MapFilePaths& paths, Store& store, const LaserMap& map,
                                       const MappedSessions& mapped, const MapCrs* crs, MapColours& colours,
                                       const std::optional<PointAttributes>& more) {
  const laser_mapper::MapView view = laser_mapper::viewFromAbove(mapped.path, kOrthoMargin, kLongestOrtho);
  std::optional<laser_mapper::MapPicture> ortho;
  if (!paths.ortho.empty()) ortho.emplace(view);
  std::optional<laser_mapper::SurfaceMesher> mesher;
  if (!paths.mesh.empty()) mesher.emplace(mapped.parameters->voxel);
  PointFiles files(paths, crs, mappedSensors(store, mapped), more);
  MapPointsDigest digest;
  std::size_t written = 0;
  forEachColouredTile(map, colours, [&](const laser_mapper::Tile& tile, const std::vector<MapPoint>& points) {
    if (more) digest.add(points);
    files.append(points);
    if (ortho) ortho->draw(points);
    if (mesher) mesher->add(tile, points);
    written += points.size();
  });
  if (more && (digest.value() != more->digest || written != more->points)) return std::nullopt;
  files.commit();
  if (ortho) writeOrtho(paths.ortho, view, *ortho);
  if (mesher) urban_nav_core::writeAtomically(paths.mesh, printMeshPly(mesher->finish()));
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
std::size_t writeColoured(const MapFilePaths& paths, Store& store, const LaserMap& map, const MappedSessions& mapped,
                          const MapCrs* crs, double memory_mb, const AttributeSource& attributes) {
  MapColours colours(store, map, mapped.sessions, memory_mb, false);
  std::optional<PointAttributes> more;
  if (attributes && !(paths.ply + paths.las).empty()) more = attributes(store, mapped.sessions.front().id);
  if (more && colours.areComputed() && !areOfMap(*more, map)) more.reset();
  if (more)
    if (const auto written = writePoints(paths, store, map, mapped, crs, colours, more)) return *written;
  return *writePoints(paths, store, map, mapped, crs, colours, std::nullopt);
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
    crs.emplace(paths.crs, store, map);
    result.reference = crs->reference();
    result.epsg = crs->epsg();
    result.crs = crs->describe();
  }
  if (!(paths.ply + paths.pcd + paths.las + paths.ortho + paths.mesh).empty())
    result.points =
        writeColoured(paths, rendering.store(), laser_map, mapped, crs ? &*crs : nullptr, memory_mb, attributes);
  if (!paths.grid.empty()) writeGrid(paths.grid, laser_map, mapped);
  for (const std::string& path : {paths.ply, paths.pcd, paths.las, paths.grid, paths.ortho, paths.mesh})
    if (!path.empty()) result.files.push_back(path);
  return result;
}

}  // namespace urban_nav
