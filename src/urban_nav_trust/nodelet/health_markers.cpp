// SPDX-License-Identifier: BSD-3-Clause
#include "health_markers.hpp"

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/marker_builder.hpp"

namespace urban_nav_trust {

namespace {

constexpr double kAbove = 2.5, kLetter = 0.25;  // m

}  // namespace

visualization_msgs::MarkerArray toMarkers(const StageHealth::Text& text) {
  urban_nav_ros::MarkerBuilder markers(urban_nav_core::frames::kBaseLink, 0);  // of the latest tf
  const std_msgs::ColorRGBA colour = text.level == StageHealth::kOk        ? urban_nav_ros::toColour(0.35, 0.9, 0.45)
                                     : text.level == StageHealth::kWarning ? urban_nav_ros::toColour(1.0, 0.8, 0.2)
                                                                           : urban_nav_ros::toColour(1.0, 0.35, 0.3);
  if (!text.lines.empty()) markers.addText("health", text.lines, {0.0, 0.0, kAbove}, kLetter, colour);
  return markers.message();
}

}  // namespace urban_nav_trust
