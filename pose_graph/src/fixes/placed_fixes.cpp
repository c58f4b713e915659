// SPDX-License-Identifier: BSD-3-Clause
#include "fixes/placed_fixes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "pose_graph/graph_file.hpp"
#include "solve/normal_equations.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace pose_graph {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr StampNs kLongestFixGap = 500'000'000;
// Rad: standard deviation of the tilt of a robot without known direction of gravity.
constexpr double kMountedUpright = 0.17;

bool isSound(const PositionFix& fix) {
  const urban_nav_core::GpsReading& reading = fix.reading;
  return std::isfinite(reading.latitude) && std::isfinite(reading.longitude) && std::isfinite(reading.height) &&
         reading.sigma.allFinite() && reading.sigma.minCoeff() > 0.0 && fix.p_base.allFinite();
}

/// The poses of a track in the graph.
struct TrackPoses {
  int first = 0;  ///< number of its first pose
  Trajectory trajectory;
};

std::optional<PlacedFix> placeFix(const PositionFix& fix, const TrackPoses& track, const std::vector<int>& component) {
  if (track.trajectory.empty()) return std::nullopt;
  const StampNs stamp = fix.reading.stamp;
  const std::size_t nearest = track.trajectory.nearest(stamp);
  const StampNs at = track.trajectory[nearest].stamp;
  PlacedFix placed;
  placed.pose = track.first + static_cast<int>(nearest);
  Pose T_pose_then;
  if (at != stamp) {
    const std::size_t other = stamp > at ? nearest + 1 : nearest - 1;  // unsigned wrap-around if there is none
    if (other >= track.trajectory.size()) return std::nullopt;
    const int other_pose = track.first + static_cast<int>(other);
    const auto then = track.trajectory.at(stamp, kLongestFixGap);
    if (!then || component[static_cast<std::size_t>(placed.pose)] != component[static_cast<std::size_t>(other_pose)])
      return std::nullopt;
    T_pose_then = track.trajectory[nearest].pose.inverse() * *then;
  }
  placed.lever = T_pose_then * fix.p_base;
  placed.sigma = fix.reading.sigma;
  return placed;
}

void findUp(const TrackPoses& track, const std::vector<SpecificForce>& forces, const Pose& T_map_first,
            FixedPart& part) {
  const Level level = estimateLevel(track.trajectory, forces, T_map_first);
  if (!level.known()) return;
  part.up = level.up;
  part.up_sigma = level.sigma;
}

}  // namespace

std::vector<FixedPart> placeFixes(const Problem<3>& accepted, const std::vector<Rigid<3>>& poses,
                                  const std::vector<std::vector<StampNs>>& stamps,
                                  const std::vector<std::vector<SpecificForce>>& forces,
                                  const std::vector<std::vector<PositionFix>>& fixes, double correlation,
                                  std::size_t& unplaced) {
  const std::vector<int> component = makeUnknowns(accepted).component;
  std::map<int, FixedPart> parts;
  std::map<int, urban_nav_core::LocalTangent> datums;
  int first = 0;
  for (std::size_t t = 0; t < stamps.size(); ++t) {
    TrackPoses track;
    track.first = first;
    for (const StampNs stamp : stamps[t])
      track.trajectory.append(stamp, toPose(poses[static_cast<std::size_t>(first++)]));
    std::optional<StampNs> before;
    for (const PositionFix& fix : fixes[t]) {
      std::optional<PlacedFix> placed;
      if (isSound(fix) && (!before || fix.reading.stamp > *before)) placed = placeFix(fix, track, component);
      if (!placed) {
        ++unplaced;
        continue;
      }
      const int of = component[static_cast<std::size_t>(placed->pose)];
      const auto [part, is_new] = parts.try_emplace(of);
      if (is_new) {
        datums.try_emplace(of, fix.reading.position());
        part->second.first_pose =
            static_cast<int>(std::find(component.begin(), component.end(), of) - component.begin());
      }
      if (part->second.up_sigma <= 0.0)
        findUp(track, forces[t], toPose(poses[static_cast<std::size_t>(part->second.first_pose)]), part->second);
      if (before)
        placed->share = std::min(1.0, urban_nav_core::secondsBetween(*before, fix.reading.stamp) / (2.0 * correlation));
      before = fix.reading.stamp;
      placed->measured = datums.at(of).toLocal(fix.reading.position());
      part->second.fixes.push_back(*placed);
    }
  }
  std::vector<FixedPart> made;
  for (auto& [number, part] : parts) {
    if (part.up_sigma <= 0.0) part.up_sigma = kMountedUpright;
    made.push_back(std::move(part));
  }
  return made;
}

}  // namespace pose_graph
