// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "pose_graph/map_levels.hpp"
#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::Trajectory;
using urban_nav_core::UserError;

namespace {

Trajectory makeTrajectory(const Track& track, const std::vector<Pose>& pose_table) {
  Trajectory made;
  for (std::size_t i = 0; i < pose_table.size(); ++i) made.append(track.stamps[i], pose_table[i]);
  return made;
}

}  // namespace

std::size_t findMap(const std::vector<Track>& tracks, std::size_t track) {
  const std::vector<int>& parts = tracks[track].part;
  if (parts.empty() || std::any_of(parts.begin(), parts.end(), [&](int each) { return each != parts.front(); }))
    return track;
  for (std::size_t earlier = 0; earlier < track; ++earlier)
    if (!tracks[earlier].part.empty() && tracks[earlier].part.front() == parts.front()) return earlier;
  return track;
}

Pose levelling(const Level& level, const Pose& T_map_first) {
  if (!level.known()) return {};
  return Pose(Eigen::Quaterniond(level.R_map_first), Eigen::Vector3d::Zero()) * T_map_first.inverse();
}

void PoseGraph::putForces(const SessionId& session, const std::vector<SpecificForce>& forces) {
  const auto found = track_of_.find(session);
  if (found == track_of_.end()) throw UserError("pose_graph", "no session " + session, "a session of the graph");
  if (forces.empty()) return;
  std::vector<SpecificForce>& known = forces_[found->second];
  while (!known.empty() && known.back().stamp >= forces.front().stamp) known.pop_back();
  known.insert(known.end(), forces.begin(), forces.end());
}

void PoseGraph::putGround(const SessionId& session, const std::vector<GroundNormal>& normals) {
  const auto found = track_of_.find(session);
  if (found == track_of_.end()) throw UserError("pose_graph", "no session " + session, "a session of the graph");
  std::vector<GroundNormal>& known = ground_[found->second];
  for (const GroundNormal& normal : normals)
    if (known.empty() || normal.stamp > known.back().stamp) known.push_back(normal);
}

bool PoseGraph::isLevel(const SessionId& session) const {
  const auto found = track_of_.find(session);
  return found != track_of_.end() && level_[findMap(tracks_, found->second)];
}

std::vector<std::size_t> PoseGraph::level(PoseTable& pose_table, bool stay) {
  std::vector<Level> levels(tracks_.size());
  std::vector<std::size_t> maps;
  for (std::size_t t = 0; t < tracks_.size(); ++t) maps.push_back(findMap(tracks_, t));
  const auto estimate = [&](const auto& measured) {
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      const std::size_t map = maps[t];
      if (levels[map].known() || measured[t].empty() || pose_table[map].empty() || (stay && level_[map])) continue;
      levels[map] = estimateLevel(makeTrajectory(tracks_[t], pose_table[t]), measured[t], pose_table[map].front());
    }
  };
  estimate(forces_);
  estimate(ground_);
  std::vector<std::size_t> first_time;
  std::vector<Pose> turns;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    turns.push_back(levels[t].known() ? levelling(levels[t], pose_table[t].front()) : Pose());
    if (levels[t].known() && !level_[t]) first_time.push_back(t);
    if (!stay || levels[t].known()) level_[t] = levels[t].known();
  }
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    if (levels[maps[t]].known())
      for (Pose& pose : pose_table[t]) pose = turns[maps[t]] * pose;
  return first_time;
}

bool PoseGraph::isOfRunning(const std::vector<std::size_t>& maps) const {
  return !tracks_.empty() && std::count(maps.begin(), maps.end(), findMap(tracks_, running_)) > 0;
}

std::optional<Relaxed> PoseGraph::level() {
  PoseTable pose_table;
  for (const Track& track : tracks_) pose_table.push_back(track.map);
  const Before before = this->before();
  const std::vector<std::size_t> levelled = level(pose_table, true);
  if (levelled.empty()) return std::nullopt;
  live_.reset();
  Relaxed made;
  reportCorrection(made, applyPoses(pose_table), before, isOfRunning(levelled));
  return made;
}

}  // namespace pose_graph
