// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_live/stereo_input_parameters.hpp"

namespace urban_nav_localization {

/// Parameters of the nodelet that localises alone: map, frames, transport. One member per row of nodeletTable().
struct NodeletParameters : urban_nav_live::StereoInputParameters {
  std::string store;
  bool stereo;
  std::string map_frame;
  std::string odom_frame;
  bool publish_tf;
  double path_spacing;  // m

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace urban_nav_localization
