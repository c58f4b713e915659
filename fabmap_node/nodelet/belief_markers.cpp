// SPDX-License-Identifier: BSD-3-Clause
#include "belief_markers.hpp"

#include <vector>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_ros/marker_builder.hpp"

namespace fabmap_node {

using urban_nav_ros::toColour;

namespace {

constexpr double kDot = 0.25, kCertainPlace = 1.2, kLineWidth = 0.08, kTextHeight = 0.5;  // m
const Eigen::Vector3d kAboveRobot(0.0, 0.0, 2.0);                                         // m

std_msgs::ColorRGBA knowledgeColour(PlaceKnowledge knowledge, double alpha = 1.0) {
  if (knowledge == PlaceKnowledge::Known) return toColour(0.2, 0.8, 0.3, alpha);
  if (knowledge == PlaceKnowledge::Unsure) return toColour(1.0, 0.6, 0.1, alpha);
  return toColour(0.35, 0.55, 0.95, alpha);
}

std::string printBelief(const BeliefTrail::Point& point) {
  const std::string known = urban_nav_core::formatNumber(1.0 - point.p_new, 3);
  std::string printed = std::string(toString(point.knowledge)) + ", known place: " + known;
  if (point.likeliest && !point.likeliest->at.session.empty()) printed += "\nof session " + point.likeliest->at.session;
  return printed;
}

}  // namespace

visualization_msgs::MarkerArray toMarkers(const BeliefTrail& trail, const std::string& odom_frame) {
  const BeliefTrail::Point& last = trail.points().back();
  urban_nav_ros::MarkerBuilder markers(odom_frame, last.stamp);
  for (const auto knowledge : {PlaceKnowledge::Known, PlaceKnowledge::Unsure, PlaceKnowledge::New}) {
    std::vector<Eigen::Vector3d> points;
    for (const BeliefTrail::Point& point : trail.points())
      if (point.knowledge == knowledge) points.push_back(point.p_odom);
    markers.addSpheres(toString(knowledge), points, kDot, knowledgeColour(knowledge));
  }
  markers.addText("belief", printBelief(last), last.p_odom + kAboveRobot, kTextHeight, knowledgeColour(last.knowledge));
  if (!last.likeliest || !last.likeliest->at.session.empty()) return markers.message();
  const BeliefTrail::Point* place = trail.find(last.likeliest->at.stamp);
  if (place == nullptr) return markers.message();
  markers.addSpheres("likeliest place", {place->p_odom}, kDot + kCertainPlace * last.likeliest->probability,
                     knowledgeColour(last.knowledge, 0.5));
  markers.addLines("match", {last.p_odom, place->p_odom}, kLineWidth, knowledgeColour(last.knowledge));
  return markers.message();
}

}  // namespace fabmap_node
