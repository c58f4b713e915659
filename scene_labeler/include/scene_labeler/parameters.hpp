// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace scene_labeler {

/// Parameters of the stage, one member per row of table().
struct Parameters {
  std::string model;
  double precision;  // share of the sure labels that is right
  int superpixel;              // px
  int samples;                 // per class
  double spacing;              // m
  double projection_distance;  // m
  std::string class_topic, class_file;
  double class_accuracy;

  Parameters();
};

/// Table of the stage: defaults, ranges, units and descriptions.
const urban_nav_core::Table<Parameters>& table();

}  // namespace scene_labeler
