// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/map_colour.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/pictures/stored_panorama_view.hpp"
#include "urban_nav_registration/session/adopted_calibration.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"
#include "urban_nav_store/digest.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/map_chunk.hpp"
#include "urban_nav_store/tables/stored_panorama.hpp"
#include "urban_nav_store/tables/tile_colours.hpp"

namespace urban_nav {

using laser_mapper::ColourView;
using laser_mapper::MappedSession;
using laser_mapper::MapPoint;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_registration::PanoramaCorrection;
using urban_nav_store::StoredPanorama;
using urban_nav_store::StoredPanoramaCamera;
using urban_nav_store::TableStore;
using urban_nav_store::TileColours;

namespace {

constexpr StampNs kLongestViewGap = 500'000'000;
constexpr double kDepthShare = 0.3;  // of memory_mb: depth maps of the views; the rest: decoded images

struct SessionViews {
  std::vector<laser_mapper::MountedView> views;
  std::vector<Pose> T_map_base;  ///< of the views
  std::vector<urban_nav_registration::PanoramaKey> images;
};

/// The views to add.
enum class ViewKind { Panoramas, All };

/// Adds the views of a session with their stated extrinsics, those of its panoramic head with `correction`.
void addViews(urban_nav_store::Store& store, const MappedSession& session, const PanoramaCorrection& correction,
              ViewKind kind, SessionViews& made) {
  std::map<std::int64_t, StoredPanoramaCamera> cameras;
  TableStore<StoredPanoramaCamera>(store).forEach(session.id, [&](const StoredPanoramaCamera& row) {
    if (kind == ViewKind::All || row.camera < StoredPanoramaCamera::kFirstColour) cameras[row.camera] = row;
  });
  std::optional<Pose> last;
  std::int64_t last_camera = -1;
  TableStore<StoredPanorama>(store).forEach(session.id, [&](const StoredPanorama& row) {
    const auto camera = cameras.find(row.camera);
    if (camera == cameras.end()) return;
    const PanoramaCorrection corrected =
        row.camera < StoredPanoramaCamera::kFirstColour ? correction : PanoramaCorrection();
    const auto T_map_base = session.T_map_base->at(row.stamp - corrected.delay, kLongestViewGap);
    if (!T_map_base) return;
    if (row.camera == last_camera && last && distanceBetween(*last, *T_map_base) < kViewDistance &&
        angleBetween(*last, *T_map_base) < kViewAngle)
      return;
    last = T_map_base;
    last_camera = row.camera;
    made.views.push_back({urban_nav_registration::storedRawCamera(camera->second),
                          corrected.T_correction * camera->second.T_base_camera, row.stamp, made.images.size()});
    made.T_map_base.push_back(*T_map_base);
    made.images.push_back({session.id, row.camera, row.stamp});
  });
}

SessionViews findViews(urban_nav_store::Store& store, const std::vector<MappedSession>& sessions) {
  SessionViews found;
  for (const MappedSession& session : sessions)
    addViews(store, session, urban_nav_registration::panoramaCorrection(store, session.id), ViewKind::All, found);
  return found;
}

/// Returns a digest of the images, their poses and cameras, and of the rendered chunks of a map.
std::string digestColours(urban_nav_store::Store& store, const std::vector<MappedSession>& sessions,
                          const SessionViews& made, double voxel) {
  std::string bytes;
  urban_nav_store::appendNumber(bytes, voxel);
  for (const MappedSession& session : sessions) {
    urban_nav_store::appendText(bytes, session.id);
    TableStore<urban_nav_store::MapChunk>(store).forEach(session.id, [&](const urban_nav_store::MapChunk& chunk) {
      for (const std::int64_t value : {chunk.begin, chunk.end, chunk.beams, chunk.cells})
        urban_nav_store::appendInteger(bytes, static_cast<std::uint64_t>(value));
      for (const std::string* text : {&chunk.settings, &chunk.poses, &chunk.tiles})
        urban_nav_store::appendText(bytes, *text);
    });
  }
  for (std::size_t i = 0; i < made.views.size(); ++i) {
    const laser_mapper::MountedView& view = made.views[i];
    const urban_nav_registration::PanoramaKey& image = made.images[i];
    urban_nav_store::appendText(bytes, image.session);
    for (const std::int64_t value :
         {image.camera, image.stamp, std::int64_t{view.camera.pinhole.width}, std::int64_t{view.camera.pinhole.height}})
      urban_nav_store::appendInteger(bytes, static_cast<std::uint64_t>(value));
    const urban_nav_core::Pinhole& pinhole = view.camera.pinhole;
    for (const double value : {pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy})
      urban_nav_store::appendNumber(bytes, value);
    for (const double value : view.camera.distortion.coefficients()) urban_nav_store::appendNumber(bytes, value);
    if (view.camera.distortion.isEquidistant()) urban_nav_store::appendText(bytes, "equidistant");
    for (const Pose& pose : {made.T_map_base[i], view.T_base_camera}) {
      for (int k = 0; k < 3; ++k) urban_nav_store::appendNumber(bytes, pose.t()(k));
      for (int k = 0; k < 4; ++k) urban_nav_store::appendNumber(bytes, pose.q().coeffs()(k));
    }
  }
  return urban_nav_store::sha256(bytes);
}

std::unique_ptr<laser_mapper::Colouriser> makeViewColouriser(urban_nav_store::Store& store, const SessionViews& made,
                                                             double voxel, double memory_mb) {
  std::vector<ColourView> views;
  for (std::size_t i = 0; i < made.views.size(); ++i) {
    const laser_mapper::MountedView& view = made.views[i];
    views.push_back({view.camera, made.T_map_base[i] * view.T_base_camera, view.stamp, view.image});
  }
  double image_mb = 0.1;
  for (const laser_mapper::MountedView& view : made.views)
    image_mb = std::max(image_mb, 3e-6 * view.camera.pinhole.width * view.camera.pinhole.height);
  const auto load = [&store, images = made.images](std::size_t image) {
    return urban_nav_registration::loadPanorama(store, images[image]);
  };
  laser_mapper::ColourMemory memory;
  memory.cached_images = static_cast<std::size_t>(std::max(8.0, (1.0 - kDepthShare) * memory_mb / image_mb));
  memory.depth_bytes = static_cast<std::size_t>(1e6 * kDepthShare * memory_mb);
  memory.folder = std::filesystem::path(store.path()).parent_path().string();
  return std::make_unique<laser_mapper::Colouriser>(std::move(views), load, voxel, std::move(memory));
}

constexpr std::size_t kArrays = 4;  // of TileColours::data

std::string packColours(const std::vector<MapPoint>& points) {
  const std::size_t n = points.size();
  std::string bytes(kArrays * n, '\0');
  for (std::size_t i = 0; i < n; ++i) {
    const MapPoint& point = points[i];
    bytes[i] = static_cast<char>(point.red);
    bytes[n + i] = static_cast<char>(point.green);
    bytes[2 * n + i] = static_cast<char>(point.blue);
    bytes[3 * n + i] = static_cast<char>(point.is_coloured);
  }
  return urban_nav_store::deflated(bytes);
}

/// Sets stored colours; returns the number of coloured points. Throws DataError if they are not those of the points.
std::size_t unpackColours(const TileColours& row, const std::string& path, std::vector<MapPoint>& points) {
  const std::size_t n = points.size();
  const std::optional<std::string> bytes = urban_nav_store::inflated(row.data, kArrays * n);
  if (!bytes || bytes->size() != kArrays * n || row.points != static_cast<std::int64_t>(n))
    throw urban_nav_core::DataError(path, "the colours of tile " + row.tile + " are not those of its points", "");
  std::size_t coloured = 0;
  for (std::size_t i = 0; i < n; ++i) {
    MapPoint& point = points[i];
    point.red = static_cast<std::uint8_t>((*bytes)[i]);
    point.green = static_cast<std::uint8_t>((*bytes)[n + i]);
    point.blue = static_cast<std::uint8_t>((*bytes)[2 * n + i]);
    point.is_coloured = (*bytes)[3 * n + i] != 0;
    coloured += point.is_coloured ? 1 : 0;
  }
  return coloured;
}

}  // namespace

std::unique_ptr<laser_mapper::Colouriser> makeColouriser(urban_nav_store::Store& store,
                                                         const std::vector<MappedSession>& sessions, double voxel,
                                                         double memory_mb) {
  const SessionViews found = findViews(store, sessions);
  return found.views.empty() ? nullptr : makeViewColouriser(store, found, voxel, memory_mb);
}

MapColours::MapColours(urban_nav_store::Store& store, const laser_mapper::LaserMap& map,
                       const std::vector<MappedSession>& sessions, double memory_mb, bool keep)
    : store_(store), sessions_(sessions), keep_(keep) {
  const SessionViews made = findViews(store, sessions);
  views_ = made.views.size();
  if (views_ == 0) return;
  const double voxel = map.parameters().voxel;
  digest_ = digestColours(store, sessions, made, voxel);
  if (isStored()) return;
  if (keep_) removeStored();
  colouriser_ = makeViewColouriser(store, made, voxel, memory_mb);
  map.forEachTile(
      [&](const laser_mapper::Tile&, const std::vector<MapPoint>& points) { colouriser_->addSurface(points); });
  colouriser_->equalise();
}

MapColours::~MapColours() = default;

bool MapColours::isStored() const {
  const auto mark = TableStore<TileColours>(store_).get({sessions_.front().id, "", "", 0, ""});
  return mark && mark->digest == digest_;
}

void MapColours::removeStored() {
  TableStore<TileColours> rows(store_);
  for (const MappedSession& session : sessions_) {
    std::vector<std::string> tiles;
    rows.forEach(session.id, [&](const TileColours& row) { tiles.push_back(row.tile); });
    for (const std::string& tile : tiles) rows.remove({session.id, tile, "", 0, ""});
  }
}

std::size_t MapColours::colour(const laser_mapper::Tile& tile, std::vector<MapPoint>& points) {
  if (views_ == 0) return 0;
  TableStore<TileColours> rows(store_);
  TileColours row{sessions_.front().id, toString(tile), digest_, static_cast<std::int64_t>(points.size()), ""};
  if (colouriser_) {
    const std::size_t coloured = colouriser_->colour(points);
    row.data = packColours(points);
    if (keep_) rows.put(row);
    return coloured;
  }
  const std::optional<TileColours> stored = rows.get(row);
  if (!stored || stored->digest != digest_)
    throw urban_nav_core::DataError(store_.path(), "the colours of tile " + row.tile + " are missing", "");
  return unpackColours(*stored, store_.path(), points);
}

void MapColours::finish() {
  if (!keep_ || !colouriser_) return;
  TableStore<TileColours>(store_).put({sessions_.front().id, "", digest_, 0, ""});
  store_.commit();
}

std::optional<laser_mapper::ViewCalibration> calibratePanoramas(urban_nav_store::Store& store,
                                                                const MappedSession& session,
                                                                const urban_nav_core::OdometryChain& odometry,
                                                                const laser_mapper::LaserMap& map) {
  SessionViews made;
  addViews(store, session, {}, ViewKind::Panoramas, made);
  if (made.views.empty()) return std::nullopt;
  laser_mapper::ViewCalibrator calibrator(made.views, *session.T_map_base, &odometry, map.parameters().voxel,
                                          map.parameters().range_bias);
  map.forEachTile([&](const laser_mapper::Tile&, const std::vector<laser_mapper::MapPoint>& points) {
    calibrator.addSurface(points);
  });
  return calibrator.estimate(urban_nav_registration::kPanoramaDevice, [&](std::size_t image) {
    return urban_nav_registration::loadPanorama(store, made.images[image]);
  });
}

}  // namespace urban_nav
