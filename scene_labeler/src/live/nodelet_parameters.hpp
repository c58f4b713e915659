// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace scene_labeler {

/// Parameters of the nodelet, one member per row of nodeletTable().
struct NodeletParameters {
  std::string base_frame, odom_frame;
  bool compressed, always;
  int queue_size;  // messages
  double drain_s;  // s

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace scene_labeler
