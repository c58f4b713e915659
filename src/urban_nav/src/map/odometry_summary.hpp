// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "map/context.hpp"

namespace urban_nav {

/// Returns the source of the step to each smoothed frame but the first.
std::vector<urban_nav_core::StepSource> stepSources(const SessionOdometry& run);

/// Number of odometry steps by sensor.
struct StepCounts {
  std::int64_t stereo = 0, laser = 0, both = 0, none = 0;
};
/// Adds the steps of a session.
void addSteps(const SessionOdometry& run, StepCounts& counts);

/// Returns the constant of this name, null if it is not among them.
const urban_nav_core::SharedConstant* findConstant(const OdometryFusion& fusion, const std::string& name);

/// Returns the object "odometry" of summary.json: the source, the number of steps by sensor, and the common constants
/// of both sources from the session with the most accurate scale.
Json odometryJson(const MapContext& context);

}  // namespace urban_nav
