// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include <string>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav_localization {

/// Converts an initial pose in `map_frame`. A pose drawn on a plane (rviz states no variance of height, roll and pitch)
/// gets the height of the nearest pose of the map, with the uncertainty of a wheeled robot. Throws UserError, which
/// begins with `where`, for another frame, an invalid pose and an invalid covariance.
urban_nav_core::PoseWithCovariance toInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message,
                                                 const std::string& map_frame, const std::string& where,
                                                 const std::vector<urban_nav_store::StoredTrajectory>& map);

}  // namespace urban_nav_localization
