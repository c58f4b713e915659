// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace pose_graph {

/// Parameters of the nodelet other than those of the graph (pose_graph/parameters.hpp): frames, session, display. One
/// member per row of nodeletTable().
struct NodeletParameters {
  std::string map_frame;
  std::string odom_frame;
  std::string base_frame;
  bool publish_tf;
  std::string robot;
  std::string recording;
  std::string store;
  int queue_size;               // messages
  double visualization_period;  // s
  double path_spacing;          // m
  bool ground;

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace pose_graph
