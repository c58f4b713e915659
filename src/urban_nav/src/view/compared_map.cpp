// SPDX-License-Identifier: BSD-3-Clause
#include "view/compared_map.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/stored_ids.hpp"
#include "view/state_json.hpp"

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_store::StoredTrajectory;

namespace {

constexpr StampNs kMaxGap = 1'000'000'000;  // ns between poses for interpolation

std::string nameOrId(const urban_nav_store::Session& session) {
  return session.name.empty() ? session.id : session.name;
}

/// Displacements of the poses of one session.
struct Displacements {
  std::size_t count = 0;
  double largest = 0.0, squares = 0.0, seconds = 0.0;

  void add(double metres, double at) {
    ++count;
    squares += metres * metres;
    if (metres < largest) return;
    largest = metres;
    seconds = at;
  }
};

Displacements displacementsFrom(const Trajectory& other, const StoredTrajectory& shown) {
  Displacements found;
  for (const urban_nav_core::StampedPose& pose : shown.T_map_base)
    if (const std::optional<Pose> there = other.at(pose.stamp, kMaxGap))
      found.add((pose.pose.t() - there->t()).norm(),
                urban_nav_core::secondsBetween(shown.T_map_base.front().stamp, pose.stamp));
  return found;
}

}  // namespace

ComparedMap::ComparedMap(const std::string& path) : path_(path) {
  urban_nav_store::Store store = urban_nav_store::openForReading(path);
  for (const auto& map : readMaps(store, urban_nav_store::selectSessions(store, {})))
    for (const StoredTrajectory& each : map)
      sessions_.emplace(each.session.id, Session{nameOrId(each.session), Trajectory(each.T_map_base)});
}

Json ComparedMap::summary(const Maps& maps) const {
  Json sessions = Json::array(), absent_there = Json::array(), absent_here = Json::array();
  std::set<urban_nav_store::SessionId> in_both;
  std::size_t place = 0;
  for (const std::vector<StoredTrajectory>& map : maps)
    for (const StoredTrajectory& each : map) {
      const std::size_t session = place++;
      const auto other = sessions_.find(each.session.id);
      if (other == sessions_.end()) {
        absent_there.append(nameOrId(each.session));
        continue;
      }
      in_both.insert(other->first);
      const Displacements found = displacementsFrom(other->second.T_map_base, each);
      const double rms = found.count == 0 ? 0.0 : std::sqrt(found.squares / static_cast<double>(found.count));
      sessions.append(Json::object({{"session", session},
                                    {"poses", found.count},
                                    {"largest_m", found.largest},
                                    {"rms_m", rms},
                                    {"seconds", found.seconds}}));
    }
  for (const auto& [id, session] : sessions_)
    if (in_both.count(id) == 0) absent_here.append(session.name);
  return Json::object({{"store", path_},
                       {"sessions", std::move(sessions)},
                       {"absent_there", std::move(absent_there)},
                       {"absent_here", std::move(absent_here)}});
}

std::string ComparedMap::place(const Maps& maps) const {
  std::string bytes;
  for (const std::vector<StoredTrajectory>& map : maps)
    for (const StoredTrajectory& each : map) {
      const auto other = sessions_.find(each.session.id);
      for (const urban_nav_core::StampedPose& pose : each.T_map_base) {
        const std::optional<Pose> there =
            other == sessions_.end() ? std::nullopt : other->second.T_map_base.at(pose.stamp, kMaxGap);
        for (int axis = 0; axis < 3; ++axis)
          appendFloat32(bytes, there ? there->t()(axis) : std::numeric_limits<double>::quiet_NaN());
      }
    }
  return bytes;
}

}  // namespace urban_nav
