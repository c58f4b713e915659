// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_ros {

/// Returns the colour of a marker; components 0...1.
std_msgs::ColorRGBA toColour(double r, double g, double b, double a = 1.0);

/// Builds a marker array that replaces all earlier markers of its topic. Points are in the frame of the array, m;
/// `name`: namespace of the markers.
class MarkerBuilder {
 public:
  MarkerBuilder(const std::string& frame, urban_nav_core::StampNs stamp);

  /// Adds separate lines from pairs of points, if there are any. `width`: m.
  void addLines(const std::string& name, const std::vector<Eigen::Vector3d>& points, double width,
                const std_msgs::ColorRGBA& colour);
  /// Adds a connected line, if there are two or more points.
  void addStrip(const std::string& name, std::int32_t id, const std::vector<Eigen::Vector3d>& points, double width,
                const std_msgs::ColorRGBA& colour);
  /// Adds spheres, if there are points. `diameter`: m.
  void addSpheres(const std::string& name, const std::vector<Eigen::Vector3d>& points, double diameter,
                  const std_msgs::ColorRGBA& colour);
  /// Adds a text that faces the viewer, centred at `point`. `height`: of a capital letter, m.
  void addText(const std::string& name, const std::string& text, const Eigen::Vector3d& point, double height,
               const std_msgs::ColorRGBA& colour);
  const visualization_msgs::MarkerArray& message() const { return array_; }

 private:
  visualization_msgs::Marker& add(std::int32_t type, const std::string& name, std::int32_t id,
                                  const std::vector<Eigen::Vector3d>& points, double size,
                                  const std_msgs::ColorRGBA& colour);

  std_msgs::Header header_;
  visualization_msgs::MarkerArray array_;
};

}  // namespace urban_nav_ros
