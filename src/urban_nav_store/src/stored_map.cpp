// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/stored_map.hpp"

#include <algorithm>
#include <map>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;

StoredTrajectory readTrajectory(Store& store, const Session& session) {
  StoredTrajectory trajectory{session, session.id, {}, false};
  Pose T_map_odom;
  if (const auto anchor = store.sessions().anchor(session.id)) {
    trajectory.map = anchor->map;
    T_map_odom = anchor->T_map_odom;
  }
  std::map<StampNs, Pose> relaxed;
  store.graph().forEachRelaxed(
      session.id, [&](const RelaxedPose& pose) { relaxed.emplace_hint(relaxed.end(), pose.stamp, pose.T_map_base); });
  trajectory.relaxed = !relaxed.empty();
  store.graph().forEachNode(session.id, [&](const Node& node) {
    const auto found = relaxed.find(node.stamp);
    if (found != relaxed.end()) {
      trajectory.T_map_base.push_back({node.stamp, found->second});
      T_map_odom = found->second * node.T_odom_base.inverse();
    } else if (trajectory.relaxed || trajectory.map != session.id) {
      trajectory.T_map_base.push_back({node.stamp, T_map_odom * node.T_odom_base});
    } else {
      trajectory.T_map_base.push_back({node.stamp, node.T_odom_base});
    }
  });
  return trajectory;
}

std::vector<Session> selectSessions(Store& store, const std::vector<std::string>& wanted) {
  std::vector<Session> sessions = store.sessions().all();
  std::string known;
  for (const Session& session : sessions) known += (known.empty() ? "" : ", ") + session.id + " (" + session.name + ")";
  const auto begins = [](const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; };
  for (const std::string& each : wanted) {
    if (std::none_of(sessions.begin(), sessions.end(),
                     [&](const Session& session) { return begins(session.id, each) || begins(session.name, each); }))
      throw UserError(store.path(), "has no session " + each, known.empty() ? "none: it is empty" : known);
  }
  if (wanted.empty()) return sessions;
  sessions.erase(std::remove_if(sessions.begin(), sessions.end(),
                                [&](const Session& session) {
                                  return std::none_of(wanted.begin(), wanted.end(), [&](const std::string& each) {
                                    return begins(session.id, each) || begins(session.name, each);
                                  });
                                }),
                 sessions.end());
  return sessions;
}

std::vector<std::vector<StoredTrajectory>> readMaps(Store& store, const std::vector<Session>& sessions) {
  std::vector<std::vector<StoredTrajectory>> maps;
  for (const Session& session : sessions) {
    StoredTrajectory trajectory = readTrajectory(store, session);
    const auto same =
        std::find_if(maps.begin(), maps.end(), [&](const auto& map) { return map.front().map == trajectory.map; });
    if (same == maps.end()) {
      maps.push_back({std::move(trajectory)});
    } else {
      same->push_back(std::move(trajectory));
    }
  }
  return maps;
}

}  // namespace urban_nav_store
