// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "base/json.hpp"
#include "map/context.hpp"

namespace urban_nav {

/// Steps of odometry by what measured them.
struct StepCounts {
  std::int64_t stereo = 0, laser = 0, both = 0, none = 0;
};
/// Adds the steps of a session.
void addSteps(const SessionOdometry& run, StepCounts& counts);

/// Returns the constant of this name, null if it is not among them.
const urban_nav_core::SharedConstant* findConstant(const OdometryFusion& fusion, const std::string& name);

/// Returns the object "odometry" of summary.json: the source, how many steps each one has measured, and the constants
/// that both sources share, of the session that knows the scale best.
Json odometryJson(const MapContext& context);

}  // namespace urban_nav
