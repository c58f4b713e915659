// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/revisits.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "laser_mapper/chunk_renderer.hpp"
#include "laser_mapper/passes.hpp"

namespace laser_mapper {

using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr double kSampleStep = 1.0;  // m between compared positions

/// Position on the path of a pass.
struct PathPoint {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< m, in the map
  StampNs chunk = 0;
  std::size_t session = 0;
  std::uint16_t pass = 0;
};

/// Returns positions at least kSampleStep apart, or in different chunks.
std::vector<PathPoint> samplePaths(const std::vector<const Trajectory*>& T_map_base) {
  const std::vector<SessionPasses> passes = findPasses(T_map_base);
  std::vector<PathPoint> points;
  for (std::size_t s = 0; s < T_map_base.size(); ++s)
    for (const urban_nav_core::StampedPose& pose : *T_map_base[s]) {
      const StampNs chunk = chunkBegin(pose.stamp);
      if (!points.empty() && points.back().session == s && points.back().chunk == chunk &&
          (points.back().p - pose.pose.t()).norm() < kSampleStep)
        continue;
      points.push_back({pose.pose.t(), chunk, s, passes[s].at(pose.stamp)});
    }
  return points;
}

}  // namespace

std::vector<std::set<StampNs>> findRevisitedChunks(const std::vector<const Trajectory*>& T_map_base, double reach) {
  const std::vector<PathPoint> points = samplePaths(T_map_base);
  const auto square = [&](const Eigen::Vector3d& p) {
    return std::make_pair(std::llround(p.x() / reach), std::llround(p.y() / reach));
  };
  std::map<std::pair<long long, long long>, std::vector<const PathPoint*>> squares;
  for (const PathPoint& point : points) squares[square(point.p)].push_back(&point);
  std::vector<std::set<StampNs>> chunks(T_map_base.size());
  for (const PathPoint& point : points) {
    std::set<StampNs>& known = chunks[point.session];
    if (known.count(point.chunk) != 0) continue;
    const auto [x, y] = square(point.p);
    for (int i = 0; i < 9; ++i) {
      const auto found = squares.find({x + i % 3 - 1, y + i / 3 - 1});
      if (found == squares.end()) continue;
      for (const PathPoint* other : found->second)
        if (other->pass != point.pass && (other->p - point.p).norm() < reach) known.insert(point.chunk);
    }
  }
  return chunks;
}

}  // namespace laser_mapper
