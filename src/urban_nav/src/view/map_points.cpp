// SPDX-License-Identifier: BSD-3-Clause
#include "view/map_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/map_layer.hpp"
#include "topics/lasers/map_export.hpp"
#include "urban_nav_core/sequence/even_thinning.hpp"
#include "view/state_json.hpp"

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr float kShownSigma = 0.5e-3F;  // m, of one step

/// Trajectories of all sessions, in the order of their maps.
std::vector<Trajectory> allTrajectories(const MapPoints::Maps& maps) {
  std::vector<Trajectory> all;
  for (const auto& map : maps)
    for (const urban_nav_store::StoredTrajectory& each : map) all.emplace_back(each.T_map_base);
  return all;
}

/// Returns the pose at a time, clamped to the first or last one.
std::optional<Pose> poseWithin(const Trajectory& trajectory, StampNs stamp) {
  if (trajectory.empty()) return std::nullopt;
  const StampNs first = trajectory[0].stamp, last = trajectory[trajectory.size() - 1].stamp;
  return trajectory.at(std::clamp(stamp, first, last), std::numeric_limits<StampNs>::max());
}

/// Returns the session of a map at a time, else the nearest one.
std::size_t sessionAt(const std::vector<Trajectory>& all, std::size_t begin, std::size_t end, StampNs stamp) {
  std::size_t best = begin;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = begin; s < end; ++s) {
    if (all[s].empty()) continue;
    const StampNs inside = std::clamp(stamp, all[s][0].stamp, all[s][all[s].size() - 1].stamp);
    const double apart = std::abs(urban_nav_core::secondsBetween(inside, stamp));
    if (apart < least) {
      least = apart;
      best = s;
    }
  }
  return best;
}

void appendByte(std::string& bytes, unsigned value) { bytes += static_cast<char>(value & 255U); }

}  // namespace

MapPoints::MapPoints(urban_nav_store::Store& store, const Maps& maps, double memory_mb) {
  const std::vector<Trajectory> all = allTrajectories(maps);
  urban_nav_core::EvenThinning<Point> thinned(kMostShownPoints);
  std::size_t begin = 0;
  for (const auto& map : maps) {
    const std::size_t end = begin + map.size();
    forEachMapTile(store, map, memory_mb, [&](const std::vector<laser_mapper::MapPoint>& points) {
      for (const laser_mapper::MapPoint& shown : points)
        thinned.add({begin, shown.stamp, Eigen::Vector3d::Zero(), shown});
    });
    begin = end;
  }
  points_ = thinned.items();
  std::size_t last = 0;
  for (Point& point : points_) {
    begin = last = 0;
    for (const auto& map : maps) {
      last = begin + map.size();
      if (point.session < last) break;
      begin = last;
    }
    point.session = sessionAt(all, begin, last, point.stamp);
    if (const auto T_map_base = poseWithin(all[point.session], point.stamp))
      point.p_base = T_map_base->inverse() * point.shown.p.cast<double>();
  }
}

std::string MapPoints::place(const Maps& maps) const {
  const std::vector<Trajectory> all = allTrajectories(maps);
  std::string bytes;
  bytes.reserve(24 * points_.size());
  for (const Point& point : points_) {
    if (point.session >= all.size()) continue;
    const auto T_map_base = poseWithin(all[point.session], point.stamp);
    if (!T_map_base) continue;
    const Eigen::Vector3d p = *T_map_base * point.p_base;
    for (int axis = 0; axis < 3; ++axis) appendFloat32(bytes, p(axis));
    appendFloat32(bytes, urban_nav_core::secondsBetween(all[point.session][0].stamp, point.stamp));
    const laser_mapper::MapPoint& shown = point.shown;
    appendByte(bytes, static_cast<unsigned>(point.session));
    appendByte(bytes, static_cast<unsigned>(point.session >> 8U));
    appendByte(bytes, shown.laser);
    appendByte(bytes, static_cast<unsigned>(std::lround(std::clamp(shown.sigma / kShownSigma, 0.0F, 255.0F))));
    for (const std::uint8_t value : {shown.red, shown.green, shown.blue, shown.intensity}) appendByte(bytes, value);
  }
  return bytes;
}

}  // namespace urban_nav
