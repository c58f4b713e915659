// SPDX-License-Identifier: BSD-3-Clause
#include "stages/lasers/map_colour.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "stage/panorama_views.hpp"
#include "urban_nav_registration/session/adopted_calibration.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_panorama.hpp"

namespace urban_nav {

using laser_mapper::ColourView;
using laser_mapper::MappedSession;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_store::StoredPanorama;
using urban_nav_store::StoredPanoramaCamera;
using urban_nav_store::TableStore;

namespace {

constexpr double kViewDistance = 0.7, kViewAngle = 0.26;  // m, rad: between views of one camera
constexpr StampNs kLongestViewGap = 500'000'000;

struct SessionViews {
  std::vector<ColourView> views;
  std::vector<PanoramaKey> images;
  std::vector<Pose> T_base_camera;
};

/// `delay`: of the stamps.
void addViews(urban_nav_store::Store& store, const MappedSession& session, StampNs delay, SessionViews& made) {
  std::map<std::int64_t, StoredPanoramaCamera> cameras;
  TableStore<StoredPanoramaCamera>(store).forEach(session.id,
                                                  [&](const StoredPanoramaCamera& row) { cameras[row.camera] = row; });
  std::optional<Pose> last;
  std::int64_t last_camera = -1;
  TableStore<StoredPanorama>(store).forEach(session.id, [&](const StoredPanorama& row) {
    const auto camera = cameras.find(row.camera);
    const auto T_map_base = session.T_map_base->at(row.stamp - delay, kLongestViewGap);
    if (camera == cameras.end() || !T_map_base) return;
    if (row.camera == last_camera && last && distanceBetween(*last, *T_map_base) < kViewDistance &&
        angleBetween(*last, *T_map_base) < kViewAngle)
      return;
    last = T_map_base;
    last_camera = row.camera;
    made.views.push_back(
        {rawCamera(camera->second), *T_map_base * camera->second.T_base_camera, row.stamp, made.images.size()});
    made.images.push_back({session.id, row.camera, row.stamp});
    made.T_base_camera.push_back(camera->second.T_base_camera);
  });
}

}  // namespace

std::unique_ptr<laser_mapper::Colouriser> makeColouriser(urban_nav_store::Store& store,
                                                         const std::vector<MappedSession>& sessions, double voxel,
                                                         double memory_mb) {
  SessionViews made;
  for (const MappedSession& session : sessions)
    addViews(store, session, urban_nav_registration::panoramaDelay(store, session.id), made);
  if (made.views.empty()) return nullptr;
  const urban_nav_core::Pinhole& pinhole = made.views.front().camera.pinhole;
  const double image_mb = std::max(0.1, 3e-6 * pinhole.width * pinhole.height);
  const auto load = [&store, images = made.images](std::size_t image) { return loadPanorama(store, images[image]); };
  return std::make_unique<laser_mapper::Colouriser>(std::move(made.views), load, voxel,
                                                    static_cast<std::size_t>(std::max(8.0, memory_mb / image_mb)));
}

std::optional<laser_mapper::ViewDelay> estimatePanoramaDelay(urban_nav_store::Store& store,
                                                             const MappedSession& session,
                                                             const laser_mapper::LaserMap& map) {
  SessionViews made;
  addViews(store, session, 0, made);
  if (made.views.empty()) return std::nullopt;
  const auto pose_at = [&](std::size_t view, double delay) -> std::optional<Pose> {
    const StampNs stamp = made.views[view].stamp - std::llround(1e9 * delay);
    const auto T_map_base = session.T_map_base->at(stamp, kLongestViewGap);
    if (!T_map_base) return std::nullopt;
    return *T_map_base * made.T_base_camera[view];
  };
  laser_mapper::ViewDelayEstimator estimator(made.views, pose_at, map.parameters().voxel);
  map.forEachTile([&](const laser_mapper::Tile&, const std::vector<laser_mapper::MapPoint>& points) {
    estimator.addSurface(points);
  });
  return estimator.estimate([&](std::size_t image) { return loadPanorama(store, made.images[image]); });
}

}  // namespace urban_nav
