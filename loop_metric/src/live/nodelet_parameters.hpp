// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_live/stereo_input_parameters.hpp"

namespace loop_metric {

/// Parameters of the nodelet besides those of the stage: names, transport, timeout. One member per row of
/// nodeletTable().
struct NodeletParameters : urban_nav_live::StereoInputParameters {
  std::string robot;
  std::string recording;
  std::string store;
  double candidate_timeout;  // s

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace loop_metric
