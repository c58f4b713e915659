// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/marker_builder.hpp"

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using visualization_msgs::Marker;

namespace {

geometry_msgs::Point toPointMessage(const Eigen::Vector3d& point) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = point.z();
  return message;
}

}  // namespace

std_msgs::ColorRGBA toColour(double r, double g, double b, double a) {
  std_msgs::ColorRGBA colour;
  colour.r = static_cast<float>(r);
  colour.g = static_cast<float>(g);
  colour.b = static_cast<float>(b);
  colour.a = static_cast<float>(a);
  return colour;
}

MarkerBuilder::MarkerBuilder(const std::string& frame, urban_nav_core::StampNs stamp) {
  header_.frame_id = frame;
  header_.stamp = toRosTime(stamp);
  add(Marker::LINE_LIST, "", 0, {}, 0.0, std_msgs::ColorRGBA()).action = Marker::DELETEALL;
}

void MarkerBuilder::addLines(const std::string& name, const std::vector<Eigen::Vector3d>& points, double width,
                             const std_msgs::ColorRGBA& colour) {
  if (!points.empty()) add(Marker::LINE_LIST, name, 0, points, width, colour);
}

void MarkerBuilder::addStrip(const std::string& name, std::int32_t id, const std::vector<Eigen::Vector3d>& points,
                             double width, const std_msgs::ColorRGBA& colour) {
  if (points.size() > 1) add(Marker::LINE_STRIP, name, id, points, width, colour);
}

void MarkerBuilder::addSpheres(const std::string& name, const std::vector<Eigen::Vector3d>& points, double diameter,
                               const std_msgs::ColorRGBA& colour) {
  if (points.empty()) return;
  Marker& marker = add(Marker::SPHERE_LIST, name, 0, points, diameter, colour);
  marker.scale.y = marker.scale.z = diameter;
}

void MarkerBuilder::addText(const std::string& name, const std::string& text, const Eigen::Vector3d& point,
                            double height, const std_msgs::ColorRGBA& colour) {
  Marker& marker = add(Marker::TEXT_VIEW_FACING, name, 0, {}, 0.0, colour);
  marker.scale.z = height;
  marker.pose.position = toPointMessage(point);
  marker.text = text;
}

Marker& MarkerBuilder::add(std::int32_t type, const std::string& name, std::int32_t id,
                           const std::vector<Eigen::Vector3d>& points, double size, const std_msgs::ColorRGBA& colour) {
  array_.markers.emplace_back();
  Marker& marker = array_.markers.back();
  marker.header = header_;
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = size;
  marker.color = colour;
  marker.points.reserve(points.size());
  for (const Eigen::Vector3d& point : points) marker.points.push_back(toPointMessage(point));
  return marker;
}

}  // namespace urban_nav_ros
