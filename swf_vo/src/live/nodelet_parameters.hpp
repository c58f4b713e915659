// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_core/sequence/motion_input_parameters.hpp"
#include "urban_nav_live/stereo_input_parameters.hpp"

namespace swf_vo {

/// Parameters of the nodelet besides those of the filter (swf_vo/parameters.hpp): frames and transport. One member per
/// row of nodeletTable().
struct NodeletParameters : urban_nav_live::StereoInputParameters, urban_nav_core::MotionInputParameters {
  std::string odom_frame;
  std::string robot, recording;
  bool publish_tf, imu_rate;

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace swf_vo
