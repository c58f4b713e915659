// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/current_rendering.hpp"

#include <algorithm>
#include <array>

#include "laser_mapper/laser_map.hpp"
#include "map/rendered_poses.hpp"
#include "urban_nav/stored_results.hpp"
#include "urban_nav_store/merge.hpp"

namespace urban_nav {

using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

/// Tables not needed for rendering and export of points, and chunks, which are rendered again.
constexpr std::array<const char*, 12> kLeftOut = {"chunk",       "chunk_cells", "tile_colours", "tile",
                                                  "input",       "edge",        "evidence",     "edit",
                                                  "edge_number", "graph_file",  "place",        "keyframe_place"};

}  // namespace

CurrentRendering::CurrentRendering(Store& store, const std::vector<StoredTrajectory>& map) : store_(store) {
  const bool is_current = std::none_of(map.begin(), map.end(), [&](const StoredTrajectory& each) {
    return laser_mapper::storedMapParameters(store, each.session.id) && isRenderingOutdated(store, each.session.id);
  });
  if (is_current) return;
  folder_ = std::make_unique<ScratchFolder>();
  render(map);
}

CurrentRendering::~CurrentRendering() = default;

void CurrentRendering::render(const std::vector<StoredTrajectory>& map) {
  const std::string path = folder_->file("session.db");
  urban_nav_store::copyRows(
      store_.path(), path, [&](const urban_nav_store::Table& table, const std::vector<urban_nav_store::Value>& key) {
        if (std::find(kLeftOut.begin(), kLeftOut.end(), table.name) != kLeftOut.end()) return false;
        return std::any_of(map.begin(), map.end(),
                           [&](const StoredTrajectory& each) { return each.session.id == key.front().bytes; });
      });
  copy_ = std::make_unique<Store>(path, urban_nav_store::Access::Write);
  std::vector<urban_nav_core::Trajectory> trajectories;
  std::vector<std::vector<urban_nav_core::Matrix6d>> covariances;
  std::vector<urban_nav_store::SessionId> ids;
  std::optional<laser_mapper::Parameters> parameters;
  for (const StoredTrajectory& each : map) {
    const auto its = laser_mapper::storedMapParameters(store_, each.session.id);
    if (!its || each.T_map_base.empty()) continue;
    parameters = its;
    ids.push_back(each.session.id);
    trajectories.emplace_back(each.T_map_base);
    covariances.push_back(readStoredCovariances(store_, each.session.id).poses);
  }
  std::vector<laser_mapper::MappedSession> sessions;
  for (std::size_t s = 0; s < ids.size(); ++s) sessions.push_back({ids[s], &trajectories[s], &covariances[s]});
  if (parameters) laser_mapper::LaserMap(*parameters, *copy_, sessions).render();
}

}  // namespace urban_nav
