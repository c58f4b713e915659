// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_localization/map_search.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_registration/session/stored_beams.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"

namespace urban_nav_localization {

using urban_nav_core::DataError;
using urban_nav_core::StampNs;
using urban_nav_registration::kCalibrationProperty;
using urban_nav_registration::kKeyframeCamera;

using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

std::string readProperty(Store& store, const urban_nav_store::SessionId& id, const std::string& name) {
  for (const urban_nav_store::Property& property : store.sessions().properties(id))
    if (property.name == name) return property.value;
  return {};
}

/// Returns the keyframes of a session that have a pose.
std::vector<MapKeyframe> findKeyframes(Store& store, const StoredTrajectory& session) {
  std::vector<MapKeyframe> views;
  const std::vector<StampNs> stamps = store.keyframes().stamps(session.session.id, kKeyframeCamera);
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
    Views made{readProperty(store, session.session.id, kCalibrationProperty),
               urban_nav_localization::findKeyframes(store, session)};
    if (!made.views.empty()) views_.push_back(std::move(made));
  }
  const auto hasBeams = [&](const StoredTrajectory& session) {
    return !urban_nav_registration::storedBeamSources(store, session.session.id).empty();
  };
  if (views_.empty() && std::none_of(sessions_.begin(), sessions_.end(), hasBeams))
    throw DataError(path_,
                    "holds no keyframes and no scans or sweeps: map stores them unless --stages leaves out loops and "
                    "lasers",
                    "");
}

std::vector<MapKeyframe> FrozenMap::findKeyframes(const urban_nav_registration::MountedCamera& camera) const {
  if (views_.empty())
    throw DataError(path_, "holds no keyframes: map stores them unless --stages leaves loops out", "");
  std::vector<MapKeyframe> views;
  for (const Views& each : views_) {
    bool is_known = false;
    const auto conversion = urban_nav_registration::findConversion(each.camera, camera, is_known);
    if (!is_known) continue;
    for (MapKeyframe view : each.views) {
      if (conversion) view.T_map_base = view.T_map_base * conversion->T_base_virtual();
      view.conversion = conversion;
      views.push_back(std::move(view));
    }
  }
  if (views.empty()) throw DataError(path_, "its keyframes are of an unknown camera", "");
  return views;
}

}  // namespace urban_nav_localization
