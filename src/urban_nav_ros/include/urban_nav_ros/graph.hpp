// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urban_nav_msgs/EdgeRef.h>
#include <urban_nav_msgs/GraphUpdate.h>
#include <urban_nav_msgs/PoseCorrection.h>

#include <optional>
#include <string>

#include "urban_nav_core/types/graph_update.hpp"

namespace urban_nav_ros {

urban_nav_msgs::EdgeRef toEdgeRefMessage(const urban_nav_core::EdgeRef& edge);
urban_nav_core::EdgeRef toEdgeRef(const urban_nav_msgs::EdgeRef& message);

/// Converts a segment; empty for an invalid pose, stamps that do not increase, or different numbers of poses and
/// stamps.
urban_nav_msgs::TrajectorySegment toTrajectorySegmentMessage(const urban_nav_core::TrajectorySegment& run);
std::optional<urban_nav_core::TrajectorySegment> toTrajectorySegment(const urban_nav_msgs::TrajectorySegment& message);

/// `newest`: stamp of the newest pose in the graph. Reading returns empty for an update with an invalid segment.
urban_nav_msgs::GraphUpdate toGraphUpdateMessage(const urban_nav_core::GraphUpdate& update,
                                                 urban_nav_core::StampNs newest, const std::string& map_frame);
std::optional<urban_nav_core::GraphUpdate> toGraphUpdate(const urban_nav_msgs::GraphUpdate& message);

urban_nav_msgs::PoseCorrection toPoseCorrectionMessage(const urban_nav_core::PoseCorrection& jump,
                                                       const std::string& map_frame);
std::optional<urban_nav_core::PoseCorrection> toPoseCorrection(const urban_nav_msgs::PoseCorrection& message);

}  // namespace urban_nav_ros
