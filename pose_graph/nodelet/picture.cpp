// SPDX-License-Identifier: BSD-3-Clause
#include "picture.hpp"

#include <cstdint>

#include "urban_nav_ros/stamp.hpp"

namespace pose_graph {

using urban_nav_core::PoseRun;
using urban_nav_ros::toRosTime;
using visualization_msgs::Marker;

namespace {

constexpr double thin = 0.05, thick = 0.12;  // m; the robot is half a metre wide

std_msgs::ColorRGBA colour(double r, double g, double b, double a = 1.0) {
  std_msgs::ColorRGBA c;
  c.r = static_cast<float>(r);
  c.g = static_cast<float>(g);
  c.b = static_cast<float>(b);
  c.a = static_cast<float>(a);
  return c;
}

struct Style {
  Tie::Look look;
  const char* name;
  std_msgs::ColorRGBA colour;
  double width;
};

const std::vector<Style>& styles() {
  static const std::vector<Style> all = {
      {Tie::Look::Stereo, "stereo", colour(0.1, 0.7, 0.2), thick},
      {Tie::Look::Icp, "icp", colour(0.6, 0.2, 0.7), thick},
      {Tie::Look::Plane, "plane", colour(0.2, 0.6, 0.8), thin},
      {Tie::Look::Asserted, "asserted", colour(1.0, 1.0, 1.0), thick},
      {Tie::Look::Session, "session", colour(0.6, 0.6, 0.6), thin},
      {Tie::Look::Waiting, "waiting", colour(1.0, 0.6, 0.0), thick},
      {Tie::Look::Rejected, "rejected", colour(0.9, 0.1, 0.1, 0.4), thin},
  };
  return all;
}

geometry_msgs::Point point(const Eigen::Vector3d& p) {
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = p.z();
  return message;
}

Marker marker(std::int32_t type, const std_msgs::Header& header, const std::string& name, std::int32_t id) {
  Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray toMarkers(const std::vector<Tie>& ties, const std::vector<PoseRun>& runs,
                                          urban_nav_core::StampNs stamp, const std::string& map_frame) {
  visualization_msgs::MarkerArray array;
  std_msgs::Header header;
  header.frame_id = map_frame;
  header.stamp = toRosTime(stamp);
  Marker clear = marker(Marker::LINE_LIST, header, "", 0);
  clear.action = Marker::DELETEALL;
  array.markers.push_back(clear);
  for (const Style& style : styles()) {
    Marker lines = marker(Marker::LINE_LIST, header, style.name, 0);
    lines.scale.x = style.width;
    lines.color = style.colour;
    for (const Tie& tie : ties) {
      if (tie.look != style.look) continue;
      lines.points.push_back(point(tie.p_map_a));
      lines.points.push_back(point(tie.p_map_b));
    }
    if (!lines.points.empty()) array.markers.push_back(lines);
  }
  std::int32_t id = 0;
  for (const PoseRun& run : runs) {
    Marker strip = marker(Marker::LINE_STRIP, header, "trajectory", id++);
    strip.scale.x = thin;
    strip.color = colour(0.2, 0.4, 1.0);
    for (const auto& pose : run.poses) strip.points.push_back(point(pose.T_map_base.t()));
    if (strip.points.size() > 1) array.markers.push_back(strip);
  }
  return array;
}

}  // namespace pose_graph
