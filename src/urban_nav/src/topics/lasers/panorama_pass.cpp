// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/panorama_pass.hpp"

#include <algorithm>

#include "topics/lasers/map_colour.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_panorama.hpp"
#include "urban_nav_store/tables/stored_panorama_camera.hpp"

namespace urban_nav {

using urban_nav_store::StoredPanorama;
using urban_nav_store::StoredPanoramaCamera;
using urban_nav_store::TableStore;

namespace {

constexpr urban_nav_core::TravelSpacing::Spacing kPanoramaSpacing{0.5 * kViewDistance, 0.5 * kViewAngle};
constexpr const char* kPanorama = "panorama";  // role

std::optional<StoredPanoramaCamera> storedCamera(const urban_nav_input::PanoramaCamera& camera,
                                                 const urban_nav_store::SessionId& session) {
  if (!camera.calibration || !camera.T_base_camera) return std::nullopt;
  try {
    const urban_nav_core::RawCamera raw = urban_nav_core::rawCamera(*camera.calibration, camera.topic);
    StoredPanoramaCamera row;
    row.session = session;
    row.camera = static_cast<std::int64_t>(camera.number);
    row.frame = camera.frame;
    row.T_base_camera = *camera.T_base_camera;
    row.width = raw.pinhole.width;
    row.height = raw.pinhole.height;
    row.fx = raw.pinhole.fx;
    row.fy = raw.pinhole.fy;
    row.cx = raw.pinhole.cx;
    row.cy = raw.pinhole.cy;
    row.distortion = raw.distortion.coefficients();
    return row;
  } catch (const urban_nav_core::UserError&) {  // not the calibration of a camera
    return std::nullopt;
  }
}

}  // namespace

PanoramaPass::PanoramaPass(MapContext& context, const Stage::SessionStart& start)
    : SpacedPass("panoramas of a session", kPanoramaSpacing, context, start) {
  TableStore<StoredPanoramaCamera> cameras(store());
  for (const urban_nav_input::PanoramaCamera& camera : session().info.panorama) {
    const std::optional<StoredPanoramaCamera> row = storedCamera(camera, session().id);
    if (row) cameras.put(*row);
    cameras_.push_back(row ? std::optional(row->camera) : std::nullopt);
  }
}

void PanoramaPass::process(const urban_nav_ros::Panorama& panorama) {
  if (!takes(kPanorama, panorama.stamp)) return;
  TableStore<StoredPanorama> rows(store());
  for (std::size_t i = 0; i < std::min(panorama.images.size(), cameras_.size()); ++i) {
    if (!cameras_[i] || panorama.images[i].empty()) continue;
    std::string jpeg = panorama.images[i].jpeg();
    if (!jpeg.empty()) rows.put({session().id, *cameras_[i], panorama.images[i].stamp(), std::move(jpeg)});
  }
}

}  // namespace urban_nav
