// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/closure_rows.hpp"
#include "map/session_odometry.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_trust/closure_comparison.hpp"

namespace urban_nav {

/// Returns the accepted closures within a session, each with the motion between its poses by odometry, including the
/// constants of the rig. `assessments`: one for each closure.
std::vector<urban_nav_trust::ClosureDifference> closureDifferences(
    const std::string& session, const SessionOdometry& odometry,
    const std::vector<urban_nav_core::MetricClosure>& closures, const std::vector<ClosureAssessment>& assessments);

/// Returns the stored constraints from planes that the lasers measured in two passes of a session, whatever the pose
/// graph decided on them, each with the motion between its poses by odometry.
std::vector<urban_nav_trust::ClosureDifference> planeDifferences(urban_nav_store::Store& store,
                                                                 const urban_nav_store::SessionId& session,
                                                                 const SessionOdometry& odometry);

}  // namespace urban_nav
