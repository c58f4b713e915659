// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/line_markers.hpp"

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using visualization_msgs::Marker;

std_msgs::ColorRGBA toColour(double r, double g, double b, double a) {
  std_msgs::ColorRGBA colour;
  colour.r = static_cast<float>(r);
  colour.g = static_cast<float>(g);
  colour.b = static_cast<float>(b);
  colour.a = static_cast<float>(a);
  return colour;
}

LineMarkers::LineMarkers(const std::string& frame, urban_nav_core::StampNs stamp) {
  header_.frame_id = frame;
  header_.stamp = toRosTime(stamp);
  add(Marker::LINE_LIST, "", 0, {}, 0.0, std_msgs::ColorRGBA());
  array_.markers.back().action = Marker::DELETEALL;
}

void LineMarkers::addLines(const std::string& name, const std::vector<Eigen::Vector3d>& points, double width,
                           const std_msgs::ColorRGBA& colour) {
  if (!points.empty()) add(Marker::LINE_LIST, name, 0, points, width, colour);
}

void LineMarkers::addStrip(const std::string& name, std::int32_t id, const std::vector<Eigen::Vector3d>& points,
                           double width, const std_msgs::ColorRGBA& colour) {
  if (points.size() > 1) add(Marker::LINE_STRIP, name, id, points, width, colour);
}

void LineMarkers::add(std::int32_t type, const std::string& name, std::int32_t id,
                      const std::vector<Eigen::Vector3d>& points, double width, const std_msgs::ColorRGBA& colour) {
  Marker marker;
  marker.header = header_;
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = width;
  marker.color = colour;
  marker.points.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    geometry_msgs::Point message;
    message.x = point.x();
    message.y = point.y();
    message.z = point.z();
    marker.points.push_back(message);
  }
  array_.markers.push_back(std::move(marker));
}

}  // namespace urban_nav_ros
