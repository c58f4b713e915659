// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/camera_words.hpp"
#include "loop_metric/map_search.hpp"
#include "loop_metric/stored_surroundings.hpp"
#include "urban_nav_core/types/error.hpp"

namespace loop_metric {

using urban_nav_core::DataError;
using urban_nav_core::StampNs;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

std::string propertyOf(Store& store, const urban_nav_store::SessionId& id, const std::string& name) {
  for (const urban_nav_store::Property& property : store.sessions().properties(id))
    if (property.name == name) return property.value;
  return {};
}

/// Those of its keyframes that have a pose.
std::vector<MapView> storedViews(Store& store, const StoredTrajectory& session) {
  std::vector<MapView> views;
  const std::vector<StampNs> stamps = store.keyframes().stamps(session.session.id, keyframe_camera);
  auto stamp = stamps.begin();
  for (const urban_nav_core::StampedPose& pose : session.T_map_base) {
    while (stamp != stamps.end() && *stamp < pose.stamp) ++stamp;
    if (stamp != stamps.end() && *stamp == pose.stamp) views.push_back({session.session.id, pose.stamp, pose.pose});
  }
  return views;
}

}  // namespace

FrozenMap::FrozenMap(Store& store) : path_(store.path()) {
  auto maps = readMaps(store, store.sessions().all());
  if (maps.empty()) throw DataError(path_, "holds no session", "");
  sessions_ = std::move(maps.front());
  for (const StoredTrajectory& session : sessions_) {
    Views made{propertyOf(store, session.session.id, camera_property), storedViews(store, session)};
    if (!made.views.empty()) views_.push_back(std::move(made));
  }
  if (views_.empty())
    throw DataError(path_, "holds no views to recognise: map keeps them where --stages does not leave loops out", "");
}

std::vector<MapView> FrozenMap::viewsOf(const std::string& camera_words) const {
  std::vector<MapView> views;
  for (const Views& each : views_)
    if (areOfOneCamera(each.camera, camera_words)) views.insert(views.end(), each.views.begin(), each.views.end());
  if (views.empty()) throw DataError(path_, "its views are of another camera than those of this input", "");
  return views;
}

}  // namespace loop_metric
