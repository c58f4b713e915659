// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "fabmap_node/features/feature_extractor.hpp"
#include "urban_nav_core/parameters/table.hpp"

namespace fabmap_node {

/// Parameters of place recognition; one member per row of table().
struct Parameters {
  std::string model;           // file, or "default"
  double known_probability;    // announced as KNOWN above it
  double closure_probability;  // proposed as a closure above it
  double closures_per_metre;   // at most
  double enough_closures;      // expected between two stretches
  double mask;                 // s
  bool descriptor_matching, sequence;
  int panorama_features;  // of one image
  int image_features;     // of a single image

  Parameters();
};

/// The table: the only definition of the defaults, ranges, units and descriptions of these parameters.
const urban_nav_core::Table<Parameters>& table();

/// Returns the part of the parameters that feature extraction needs.
FeatureOptions featureOptions(const Parameters& parameters);

}  // namespace fabmap_node
