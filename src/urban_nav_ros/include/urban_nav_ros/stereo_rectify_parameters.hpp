// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_ros {

/// Parameters of the rectifying nodelet.
struct StereoRectifyParameters {
  std::string image_type;  // auto, raw, rectified
  bool compressed;
  int queue_size;  // messages
  double drain_s;  // s

  StereoRectifyParameters();
};

const urban_nav_core::Table<StereoRectifyParameters>& stereoRectifyTable();

}  // namespace urban_nav_ros
