// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/plane_closures.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "laser_mapper/quality/plane_search.hpp"
#include "laser_mapper/quality/shared_beams.hpp"

namespace urban_nav {

using laser_mapper::CloudClosure;
using laser_mapper::PlaneConstraint;
using urban_nav_core::Trajectory;

namespace {

constexpr const char* kPlaneSource = "laser_mapper";

/// Returns the accepted closures by ICP among `sessions`, by their indices there.
std::vector<CloudClosure> acceptedByIcp(const GraphRun& run, const std::vector<std::size_t>& sessions) {
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(sessions.begin(), sessions.end(), [&](std::size_t s) { return run.sessions[s] == name; }) -
        sessions.begin());
  };
  std::vector<CloudClosure> accepted;
  for (const auto& [id, closure] : run.graph.closures()) {
    if (closure.kind != pose_graph::EdgeKind::Icp || closure.verdict != urban_nav_core::ClosureVerdict::Accepted)
      continue;
    const std::size_t a = place(closure.a.session), b = place(closure.b.session);
    if (std::max(a, b) < sessions.size())
      accepted.push_back({a, b, closure.a.stamp, closure.b.stamp, closure.measured});
  }
  return accepted;
}

pose_graph::Closure toClosure(const PlaneConstraint& constraint, const std::string& session_a,
                              const std::string& session_b) {
  pose_graph::Closure closure;
  closure.a = {session_a, constraint.stamp_a};
  closure.b = {session_b, constraint.stamp_b};
  closure.kind = pose_graph::EdgeKind::Plane;
  closure.source = kPlaneSource;
  closure.measured = constraint.measured;
  return closure;
}

/// Returns the drift of odometry along a session, scaled by the variance factor estimated from the closures.
laser_mapper::OdometryDrift readDrift(const pose_graph::PoseGraph& graph, const std::string& session) {
  laser_mapper::OdometryDrift drift;
  for (std::size_t t = 0; t < graph.tracks().size(); ++t) {
    if (graph.tracks()[t].session != session) continue;
    for (std::size_t pose = 1; pose < graph.tracks()[t].stamps.size(); ++pose)
      if (const urban_nav_core::RelativePose* step = graph.stepTo(t, pose)) drift.add(*step, graph.odometryVariance());
  }
  return drift;
}

}  // namespace

PlaneClosures findPlaneClosures(const laser_mapper::Parameters& parameters, urban_nav_store::Store& store,
                                const std::vector<urban_nav_store::SessionId>& ids, const GraphRun& run,
                                double cloud_half_length) {
  std::map<std::size_t, std::vector<std::size_t>> sessions_of_map;
  std::vector<Trajectory> trajectories;
  std::vector<laser_mapper::OdometryDrift> drift_of_session;
  for (std::size_t s = 0; s < run.sessions.size(); ++s) {
    trajectories.push_back(run.trajectory(s));
    drift_of_session.push_back(readDrift(run.graph, run.sessions[s]));
    if (!trajectories[s].empty() && !store.scans().lasers(ids[s]).empty()) sessions_of_map[run.findMap(s)].push_back(s);
  }
  PlaneClosures found;
  for (const auto& [map, sessions] : sessions_of_map) {
    std::vector<laser_mapper::MappedSession> mapped;
    std::vector<const Trajectory*> T_map_base;
    std::vector<const laser_mapper::OdometryDrift*> drifts;
    for (const std::size_t s : sessions) {
      mapped.push_back({ids[s], &trajectories[s], nullptr});
      T_map_base.push_back(&trajectories[s]);
      drifts.push_back(&drift_of_session[s]);
    }
    const laser_mapper::SharedBeams by_icp(T_map_base, acceptedByIcp(run, sessions), cloud_half_length);
    for (const PlaneConstraint& constraint : by_icp.discount(
             laser_mapper::searchPlaneConstraints(parameters, store, mapped, drifts, store.path() + ".planes"))) {
      if (constraint.is_shared) ++found.shared;
      if (constraint.measured.information.isZero(0.0)) continue;
      found.closures.push_back(toClosure(constraint, run.sessions[sessions[constraint.session_a]],
                                         run.sessions[sessions[constraint.session_b]]));
    }
  }
  return found;
}

}  // namespace urban_nav
