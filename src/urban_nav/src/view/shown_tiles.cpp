// SPDX-License-Identifier: BSD-3-Clause
#include "view/shown_tiles.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/tiles/tile_store.hpp"
#include "map/rendered_poses.hpp"
#include "topics/lasers/map_export.hpp"
#include "urban_nav_store/bytes.hpp"
#include "view/state_json.hpp"

namespace urban_nav {

using laser_mapper::TileList;
using urban_nav_core::Pose;
using urban_nav_store::SessionId;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

constexpr double kSameDistance = 1e-6, kSameAngle = 1e-6;  // m, rad

std::map<SessionId, const StoredTrajectory*> bySession(const ShownTiles::Maps& maps) {
  std::map<SessionId, const StoredTrajectory*> all;
  for (const auto& map : maps)
    for (const StoredTrajectory& each : map) all[each.session.id] = &each;
  return all;
}

std::vector<Pose> withoutStamps(const StoredTrajectory& session) {
  std::vector<Pose> poses;
  for (const urban_nav_core::StampedPose& each : session.T_map_base) poses.push_back(each.pose);
  return poses;
}

/// Poses of a rendering are stored with rotations in single precision (map/rendered_poses.cpp).
bool hasStayed(const Pose& a, const Pose& b) {
  return distanceBetween(a, b) < kSameDistance && angleBetween(a, b) < kSameAngle;
}

void appendMove(std::string& bytes, const Pose& then, const Pose& now) {
  const Eigen::Quaterniond turn = (now.q() * then.q().inverse()).normalized();
  for (int k = 0; k < 4; ++k) appendFloat32(bytes, turn.coeffs()(k));
  for (const Pose* pose : {&then, &now})
    for (int k = 0; k < 3; ++k) appendFloat32(bytes, pose->t()(k));
}

}  // namespace

ShownTiles::ShownTiles(Store& store, const Maps& maps, double memory_mb) {
  if (!readStored(store, maps)) compute(store, maps, memory_mb);
}

bool ShownTiles::readStored(Store& store, const Maps& maps) {
  const auto sessions = bySession(maps);
  std::set<SessionId> shown;
  for (const auto& map : maps)
    for (const StoredTrajectory& first : map) {
      std::optional<TileList> list = laser_mapper::storedTileList(store, first.session.id);
      if (!list) continue;
      Set set{std::move(*list), {}};
      for (const TileList::MappedPoses& each : set.list.sessions) {
        const auto session = sessions.find(each.session);
        if (session == sessions.end() || session->second->T_map_base.size() != each.poses) return false;
        if (!shown.insert(each.session).second) return false;
        std::optional<std::vector<Pose>> rendered = renderedPoses(store, *session->second);
        if (!rendered) return false;
        set.rendered.push_back(std::move(*rendered));
      }
      sets_.push_back(std::move(set));
    }
  return std::all_of(sessions.begin(), sessions.end(), [&](const auto& each) {
    return shown.count(each.first) > 0 || each.second->T_map_base.empty() ||
           !laser_mapper::storedMapParameters(store, each.first);
  });
}

void ShownTiles::compute(Store& store, const Maps& maps, double memory_mb) {
  sets_.clear();
  folder_ = std::make_unique<ScratchFolder>();
  computed_ = std::make_unique<Store>(folder_->file("tiles.db"), urban_nav_store::Access::Write);
  const auto sessions = bySession(maps);
  for (const auto& map : maps) {
    writeMapTiles(store, map, memory_mb, *computed_);
    for (const StoredTrajectory& first : map) {
      std::optional<TileList> list = laser_mapper::storedTileList(*computed_, first.session.id);
      if (!list) continue;
      Set set{std::move(*list), {}};
      for (const TileList::MappedPoses& each : set.list.sessions)
        set.rendered.push_back(withoutStamps(*sessions.at(each.session)));
      sets_.push_back(std::move(set));
    }
  }
}

Json ShownTiles::list(const TileSelection& selection) const {
  Json json = Json::object({});
  Json& sets = json["sets"] = Json::array();
  for (const Set& set : sets_) sets.append(tilesAsJson(set.list, selection));
  return json;
}

std::optional<std::string> ShownTiles::tile(Store& store, std::size_t set, const laser_mapper::LevelTile& tile) {
  if (set >= sets_.size()) return std::nullopt;
  const SessionId& first = sets_[set].list.sessions.front().session;
  if (!computed_) return laser_mapper::storedTile(store, first, tile);
  const std::lock_guard lock(mutex_);
  return laser_mapper::storedTile(*computed_, first, tile);
}

std::string ShownTiles::moves(const Maps& maps) const {
  const auto sessions = bySession(maps);
  std::string bytes;
  for (const Set& set : sets_)
    for (std::size_t s = 0; s < set.rendered.size(); ++s) {
      const std::vector<Pose>& then = set.rendered[s];
      const auto found = sessions.find(set.list.sessions[s].session);
      std::vector<Pose> now;
      if (found != sessions.end()) now = withoutStamps(*found->second);
      bool has_moved = now.size() == then.size();
      if (has_moved) has_moved = !std::equal(now.begin(), now.end(), then.begin(), hasStayed);
      urban_nav_store::appendInteger32(bytes, has_moved ? static_cast<std::uint32_t>(now.size()) : 0);
      for (std::size_t i = 0; has_moved && i < now.size(); ++i) appendMove(bytes, then[i], now[i]);
    }
  return bytes;
}

}  // namespace urban_nav
