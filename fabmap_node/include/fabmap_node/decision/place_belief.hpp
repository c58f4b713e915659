// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fabmap_node/decision/place_verdict.hpp"
#include "fabmap_node/parameters.hpp"
#include "fabmap_node/recognition/place_describer.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace fabmap_node {

/// Whether an observation shows a place of the map.
enum class PlaceKnowledge { Known, Unsure, New };
/// Returns "KNOWN", "UNSURE" or "NEW".
const char* toString(PlaceKnowledge knowledge);

/// Place of the map with its probability for an observation.
struct LikelyPlace {
  urban_nav_core::PoseRef at;
  double probability = 0.0;
  double travelled = 0.0;               ///< to the place in its session, m
  std::optional<PlaceVerdict> verdict;  ///< geometric verification, included in the probability
};

/// Place belief after an observation.
struct PlaceBelief {
  urban_nav_core::PoseRef at;
  ObservationStatus observation = ObservationStatus::Used;  ///< nothing below is set unless Used
  PlaceKnowledge knowledge = PlaceKnowledge::New;
  /// Probability of a place that is not in the map: that the likeliest one is wrong. Places of several sessions may be
  /// one place, and what is wrong with one is often wrong with all: others do not lower it.
  double p_new = 1.0;
  std::vector<LikelyPlace> likeliest;  ///< one of each session, in descending order of probability
  std::size_t words = 0;               ///< distinct words of the observation
  int agreeing = 0;                    ///< descriptors consistent with the likeliest place by appearance
  double travelled = 0.0;              ///< to the observation in its session, m
  bool is_stationary = false;          ///< the robot has not moved: the belief is that of the previous observation
};

/// Sorts the places of a belief, and sets its knowledge and `p_new` by their probabilities.
void decide(const Parameters& parameters, PlaceBelief& belief);

}  // namespace fabmap_node
