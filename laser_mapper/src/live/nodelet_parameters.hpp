// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace laser_mapper {

/// Parameters of the nodelet, one member per row of nodeletTable().
struct NodeletParameters {
  std::string base_frame, map_frame;
  double period;          // s
  double tile_bandwidth;  // MB/s
  double layer_radius;    // m
  bool live_constraints;
  int depth_cameras;
  bool compressed_depth;
  int queue_size;  // messages
  double drain_s;  // s

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace laser_mapper
