// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace swf_vo {

/// What the nodelet, and only the nodelet, must be told: names of frames, transport, patience. One member per row of
/// nodeletTable(); what the filter does is in swf_vo/parameters.hpp.
struct NodeletParameters {
  std::string odom_frame;
  std::string base_frame;
  bool publish_tf;
  std::string images;  // auto, raw, rectified
  bool compressed;
  int queue;            // messages
  double max_lateness;  // s
  double pairing;       // s
  double tf_wait;       // s

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace swf_vo
