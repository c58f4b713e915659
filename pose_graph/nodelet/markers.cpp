// SPDX-License-Identifier: BSD-3-Clause
#include "markers.hpp"

#include "urban_nav_ros/marker_builder.hpp"

namespace pose_graph {

using urban_nav_core::TrajectorySegment;
using urban_nav_ros::toColour;

namespace {

constexpr double kThin = 0.05, kThick = 0.12;  // m; the robot is half a metre wide

struct Drawing {
  ClosureMarker::Style style;
  const char* name;
  std_msgs::ColorRGBA colour;
  double width;
};

const std::vector<Drawing>& drawings() {
  using Style = ClosureMarker::Style;
  static const std::vector<Drawing> all = {
      {Style::Stereo, "stereo", toColour(0.1, 0.7, 0.2), kThick},
      {Style::Icp, "icp", toColour(0.6, 0.2, 0.7), kThick},
      {Style::Plane, "plane", toColour(0.2, 0.6, 0.8), kThin},
      {Style::Asserted, "asserted", toColour(1.0, 1.0, 1.0), kThick},
      {Style::Session, "session", toColour(0.6, 0.6, 0.6), kThin},
      {Style::Waiting, "waiting", toColour(1.0, 0.6, 0.0), kThick},
      {Style::Rejected, "rejected", toColour(0.9, 0.1, 0.1, 0.4), kThin},
  };
  return all;
}

}  // namespace

visualization_msgs::MarkerArray toMarkers(const std::vector<ClosureMarker>& closures,
                                          const std::vector<TrajectorySegment>& runs, urban_nav_core::StampNs stamp,
                                          const std::string& map_frame) {
  urban_nav_ros::MarkerBuilder markers(map_frame, stamp);
  for (const Drawing& drawing : drawings()) {
    std::vector<Eigen::Vector3d> points;
    for (const ClosureMarker& closure : closures)
      if (closure.style == drawing.style) points.insert(points.end(), {closure.p_map_a, closure.p_map_b});
    markers.addLines(drawing.name, points, drawing.width, drawing.colour);
  }
  std::int32_t id = 0;
  for (const TrajectorySegment& run : runs) {
    std::vector<Eigen::Vector3d> points;
    points.reserve(run.poses.size());
    for (const auto& pose : run.poses) points.push_back(pose.T_map_base.t());
    markers.addStrip("trajectory", id++, points, kThin, toColour(0.2, 0.4, 1.0));
  }
  return markers.message();
}

}  // namespace pose_graph
