// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/map_colour.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "urban_nav_registration/pictures/stored_panorama_view.hpp"
#include "urban_nav_registration/session/adopted_calibration.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_panorama.hpp"

namespace urban_nav {

using laser_mapper::ColourView;
using laser_mapper::MappedSession;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_registration::PanoramaCorrection;
using urban_nav_store::StoredPanorama;
using urban_nav_store::StoredPanoramaCamera;
using urban_nav_store::TableStore;

namespace {

constexpr StampNs kLongestViewGap = 500'000'000;

struct SessionViews {
  std::vector<laser_mapper::MountedView> views;
  std::vector<Pose> T_map_base;  ///< of the views
  std::vector<urban_nav_registration::PanoramaKey> images;
};

/// Adds the views of a session with their stated extrinsics and `correction`.
void addViews(urban_nav_store::Store& store, const MappedSession& session, const PanoramaCorrection& correction,
              SessionViews& made) {
  std::map<std::int64_t, StoredPanoramaCamera> cameras;
  TableStore<StoredPanoramaCamera>(store).forEach(session.id,
                                                  [&](const StoredPanoramaCamera& row) { cameras[row.camera] = row; });
  std::optional<Pose> last;
  std::int64_t last_camera = -1;
  TableStore<StoredPanorama>(store).forEach(session.id, [&](const StoredPanorama& row) {
    const auto camera = cameras.find(row.camera);
    const auto T_map_base = session.T_map_base->at(row.stamp - correction.delay, kLongestViewGap);
    if (camera == cameras.end() || !T_map_base) return;
    if (row.camera == last_camera && last && distanceBetween(*last, *T_map_base) < kViewDistance &&
        angleBetween(*last, *T_map_base) < kViewAngle)
      return;
    last = T_map_base;
    last_camera = row.camera;
    made.views.push_back({urban_nav_registration::storedRawCamera(camera->second),
                          correction.T_correction * camera->second.T_base_camera, row.stamp, made.images.size()});
    made.T_map_base.push_back(*T_map_base);
    made.images.push_back({session.id, row.camera, row.stamp});
  });
}

}  // namespace

std::unique_ptr<laser_mapper::Colouriser> makeColouriser(urban_nav_store::Store& store,
                                                         const std::vector<MappedSession>& sessions, double voxel,
                                                         double memory_mb) {
  SessionViews made;
  for (const MappedSession& session : sessions)
    addViews(store, session, urban_nav_registration::panoramaCorrection(store, session.id), made);
  if (made.views.empty()) return nullptr;
  std::vector<ColourView> views;
  for (std::size_t i = 0; i < made.views.size(); ++i) {
    const laser_mapper::MountedView& view = made.views[i];
    views.push_back({view.camera, made.T_map_base[i] * view.T_base_camera, view.stamp, view.image});
  }
  const urban_nav_core::Pinhole& pinhole = made.views.front().camera.pinhole;
  const double image_mb = std::max(0.1, 3e-6 * pinhole.width * pinhole.height);
  const auto load = [&store, images = made.images](std::size_t image) {
    return urban_nav_registration::loadPanorama(store, images[image]);
  };
  return std::make_unique<laser_mapper::Colouriser>(std::move(views), load, voxel,
                                                    static_cast<std::size_t>(std::max(8.0, memory_mb / image_mb)));
}

std::optional<laser_mapper::ViewCalibration> calibratePanoramas(urban_nav_store::Store& store,
                                                                const MappedSession& session,
                                                                const urban_nav_core::OdometryChain& odometry,
                                                                const laser_mapper::LaserMap& map) {
  SessionViews made;
  addViews(store, session, {}, made);
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
