// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/panorama_pass.hpp"

#include <algorithm>

#include "topics/lasers/map_colour.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/pictures/stored_panorama_view.hpp"
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

std::int64_t colourNumber(std::size_t camera) {
  return StoredPanoramaCamera::kFirstColour + static_cast<std::int64_t>(camera);
}

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
    urban_nav_registration::setRawCamera(raw, row);
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
  for (std::size_t i = 0; i < session().info.colour_cameras.size(); ++i) {
    const urban_nav_input::ColourCamera& camera = session().info.colour_cameras[i];
    StoredPanoramaCamera row;
    row.session = session().id;
    row.camera = colourNumber(i);
    row.frame = camera.frame;
    row.T_base_camera = camera.T_base_camera;
    urban_nav_registration::setRawCamera(camera.camera, row);
    cameras.put(row);
  }
}

void PanoramaPass::process(const urban_nav_input::ColourInput& input) {
  const urban_nav_input::ColourCamera& camera = session().info.colour_cameras.at(input.camera);
  if (input.stamp <= 0 || !takes(camera.role, input.stamp)) return;
  std::string jpeg = input.image.jpeg();
  if (!jpeg.empty())
    TableStore<StoredPanorama>(store()).put({session().id, colourNumber(input.camera), input.stamp, std::move(jpeg)});
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
