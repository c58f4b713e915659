// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_live/stereo_input_parameters.hpp"

namespace dense_stereo {

/// Parameters of the nodelet except those of the stage (dense_stereo/parameters.hpp). One member per row of
/// nodeletTable().
struct NodeletParameters : urban_nav_live::StereoInputParameters {
  bool always;
  bool gravity;

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace dense_stereo
