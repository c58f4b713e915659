// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace loop_metric {

/// What every nodelet of this package must be told of the robot that it listens to.
struct ListeningParameters {
  std::string base_frame;
  std::string images;  // auto, raw, rectified
  bool compressed;
  int queue;            // messages
  double max_lateness;  // s
  double pairing;       // s
  double tf_wait;       // s
};

/// What the nodelet of loop closures, and only it, must be told: names, transport, patience. One member per row of nodeletTable(); what the stage does is
/// in loop_metric/parameters.hpp.
struct NodeletParameters : ListeningParameters {
  std::string robot;
  std::string recording;
  std::string store;
  double patience;  // s

  NodeletParameters();
};

/// Likewise of the one that localises.
struct LocalisationParameters : ListeningParameters {
  std::string store;
  std::string map_frame;
  std::string odom_frame;
  bool publish_tf;
  double path_spacing;  // m

  LocalisationParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();
const urban_nav_core::Table<LocalisationParameters>& localisationTable();

}  // namespace loop_metric
