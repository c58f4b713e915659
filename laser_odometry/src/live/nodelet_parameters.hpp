// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_core/sequence/motion_input_parameters.hpp"

namespace laser_odometry {

/// Parameters of the nodelet besides those of the stage (laser_odometry/parameters.hpp). One member per row of
/// nodeletTable().
struct NodeletParameters : urban_nav_core::MotionInputParameters {
  std::string base_frame, odom_frame;
  std::string robot, recording;
  bool publish_tf;
  bool planar;
  bool deskewed;
  int queue_size;  // messages
  double max_lateness;  // s
  double drain_s;       // s

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace laser_odometry
