// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include <string>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace loop_metric {

/// What somebody believes of where the robot is in `map_frame`. A pose that was drawn on a plane (rviz gives no variance of height, roll and pitch) is put at the
/// height of the nearest pose of the map, good to what robots of wheels do there. Throws UserError, which begins with `where`, for another frame, a pose that is none, and a
/// covariance that is none.
urban_nav_core::PoseWithCovariance toBelief(const geometry_msgs::PoseWithCovarianceStamped& message,
                                            const std::string& map_frame, const std::string& where,
                                            const std::vector<urban_nav_store::StoredTrajectory>& map);

}  // namespace loop_metric
