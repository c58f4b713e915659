// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/compared_fixes.hpp"

#include <optional>

#include "pose_graph/parameters.hpp"
#include "urban_nav_core/geometry/geodetic.hpp"
#include "urban_nav_store/stored_fixes.hpp"
#include "urban_nav_trust/fix_comparison.hpp"

namespace urban_nav {

using urban_nav_trust::ComparedFix;

namespace {

constexpr urban_nav_core::StampNs kLongestPoseGap = 500'000'000;

/// Returns the fixes at poses of the path, with the antenna by the map.
std::vector<ComparedFix> placeFixes(const std::vector<urban_nav_core::PositionFix>& fixes,
                                    const SessionTrajectory& session) {
  std::vector<ComparedFix> placed;
  std::optional<urban_nav_core::LocalTangent> local;
  for (const urban_nav_core::PositionFix& fix : fixes) {
    const std::optional<urban_nav_core::Pose> T_map_base = session.T_map_base.at(fix.reading.stamp, kLongestPoseGap);
    if (!T_map_base) continue;
    if (!local) local.emplace(fix.reading.position());
    ComparedFix each;
    each.stamp = fix.reading.stamp;
    each.by_map = (*T_map_base * fix.p_base).head<2>();
    each.by_gps = local->toLocal(fix.reading.position()).head<2>();
    each.sigma = fix.reading.sigma.head<2>();
    const std::size_t nearest = session.T_map_base.nearest(fix.reading.stamp);
    if (nearest < session.covariances.size()) {
      const Eigen::Matrix3d R = session.T_map_base.front().pose.q().toRotationMatrix();
      each.covariance = (R * session.covariances[nearest].topLeftCorner<3, 3>() * R.transpose()).topLeftCorner<2, 2>();
    }
    placed.push_back(each);
  }
  return placed;
}

}  // namespace

void compareFixes(const MapContext& context, std::size_t session, urban_nav_trust::TestResults& results) {
  const pose_graph::Parameters& parameters = context.options.parameters.get(pose_graph::table());
  const std::vector<urban_nav_core::PositionFix> fixes =
      urban_nav_store::readFixes(*context.store, context.ids()[session]);
  if (context.relaxed && parameters.gps && !fixes.empty()) {
    results.absent.push_back({urban_nav_trust::kFixTest,
                              "GPS fixes took part in the relaxation, so that they cannot test its result "
                              "(pose_graph.gps)"});
    return;
  }
  if (fixes.empty()) {
    results.absent.push_back({urban_nav_trust::kFixTest, "no GPS fixes"});
    return;
  }
  testFixes(placeFixes(fixes, context.trajectories[session]),
            {parameters.gps_correlation, !context.runs()[session]->forces.empty()}, results);
}

}  // namespace urban_nav
