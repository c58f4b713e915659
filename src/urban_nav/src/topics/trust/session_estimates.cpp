// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/session_estimates.hpp"

#include <algorithm>

#include "pose_graph/ground_level.hpp"
#include "pose_graph/ground_views.hpp"

namespace urban_nav {

using urban_nav_trust::LidarComparison;
using urban_nav_trust::UpEstimate;

namespace {

constexpr const char* kScaleConstant = "scale";  // among the constants of a fusion

std::optional<UpEstimate> toUp(const pose_graph::Level& level) {
  if (!level.known()) return std::nullopt;
  return UpEstimate{level.up, level.covariance};
}

}  // namespace

void compareGravity(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                    const SessionOdometry& odometry, urban_nav_trust::TestResults& results) {
  const urban_nav_core::Trajectory path = smoothedTrajectory(odometry);
  if (path.empty()) return testGravity({}, {}, {}, "there is no pose", results);
  const auto grounds = pose_graph::readGround(store, session);
  if (odometry.forces.empty() || grounds.empty())
    return testGravity(
        {}, {}, {}, grounds.empty() ? "dense stereo found no ground plane" : "no accelerometer was recorded", results);
  const urban_nav_core::Pose& first = path[0].pose;
  testGravity(toUp(pose_graph::estimateLevel(path, grounds, first)),
              toUp(pose_graph::estimateLevel(path, odometry.forces, first)),
              {path[0].stamp, path[path.size() - 1].stamp},
              "too few measurements of the ground or the accelerometer to estimate the vertical", results);
}

std::optional<LidarComparison> lidarComparison(const SessionOdometry& odometry) {
  if (!odometry.fusion || odometry.settled.size() < 2) return std::nullopt;
  const OdometryFusion& fusion = *odometry.fusion;
  LidarComparison comparison;
  double seconds = 0.0;
  for (std::size_t i = 0; i < fusion.sources.size() && i + 1 < odometry.settled.size(); ++i) {
    if (fusion.sources[i] != urban_nav_core::StepSource::Both) continue;
    if (seconds == 0.0) comparison.interval.from = odometry.settled[i].stamp;
    comparison.interval.to = odometry.settled[i + 1].stamp;
    seconds += urban_nav_core::secondsBetween(odometry.settled[i].stamp, odometry.settled[i + 1].stamp);
  }
  comparison.stretches = static_cast<std::size_t>(seconds);  // each of 1 s
  comparison.spread = fusion.spread;
  comparison.contradictions = fusion.conflicts.size();
  for (const urban_nav_core::OdometryConflict& conflict : fusion.conflicts) {
    if (conflict.statistic <= comparison.largest) continue;
    comparison.largest = conflict.statistic;
    comparison.worst = {conflict.from, conflict.to};
  }
  for (const urban_nav_core::SharedConstant& constant : fusion.shared) {
    if (constant.name != kScaleConstant) continue;
    comparison.scale = constant.value;
    comparison.scale_sigma = constant.sigma;
  }
  return comparison;
}

}  // namespace urban_nav
