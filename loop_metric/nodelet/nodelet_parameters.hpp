// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace loop_metric {

/// What the nodelet, and only the nodelet, must be told: names, transport, patience. One member per row of nodeletTable(); what the stage does is
/// in loop_metric/parameters.hpp.
struct NodeletParameters {
  std::string base_frame;
  std::string images;  // auto, raw, rectified
  bool compressed;
  std::string robot;
  std::string recording;
  std::string store;
  int queue;            // messages
  double max_lateness;  // s
  double pairing;       // s
  double tf_wait;       // s
  double patience;      // s

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace loop_metric
