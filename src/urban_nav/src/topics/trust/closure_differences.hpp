// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/closure_rows.hpp"
#include "map/session_odometry.hpp"
#include "urban_nav_trust/closure_comparison.hpp"

namespace urban_nav {

/// Returns the closures within a session that the pose graph has accepted, each with the motion that the odometry of
/// the session states between its poses, constants of the rig included. `assessments`: one for each closure.
std::vector<urban_nav_trust::ClosureDifference> closureDifferences(
    const std::string& session, const SessionOdometry& odometry,
    const std::vector<urban_nav_core::MetricClosure>& closures, const std::vector<ClosureAssessment>& assessments);

}  // namespace urban_nav
