// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace fabmap_node {

/// Parameters of the nodelet of place recognition: transport and queues. One member per row of nodeletTable().
struct NodeletParameters {
  int cameras;  // cameras of the panoramic head; 1: the left camera; 0: what sends images
  bool compressed, left_compressed;
  int queue_size;       // images
  double drain_s;       // s
  double max_lateness;  // s
  std::string robot, recording;
  std::string map;    // path of a store; empty: none
  std::string store;  // path of a file; empty: none

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace fabmap_node
