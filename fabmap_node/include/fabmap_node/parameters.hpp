// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "fabmap_node/features/feature_extractor.hpp"
#include "urban_nav_core/parameters/table.hpp"

namespace fabmap_node {

/// Parameters of place recognition; one member per row of table().
struct Parameters {
  std::string model;           // file, or "default"
  double known_probability;    // threshold of KNOWN
  double closure_probability;  // threshold of proposed closures
  double closures_per_metre;   // limit
  double enough_closures;      // expected number between two parts of the path
  double mask;                 // s
  bool descriptor_matching, sequence;
  int panorama_features;  // per image
  int image_features;     // per image

  Parameters();
};

/// Returns the table, the only definition of defaults, ranges, units and descriptions of these parameters.
const urban_nav_core::Table<Parameters>& table();

/// Returns the parameters of feature extraction.
FeatureOptions featureOptions(const Parameters& parameters);

}  // namespace fabmap_node
