// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "fabmap_node/training/train_model.hpp"
#include "support/synthetic_places.hpp"

namespace fabmap_node::testing {

/// Trains a model on three drives of 40 synthetic places, one each second, with this calibration of single places in
/// place of the fitted one.
inline PlaceModel trainOnSyntheticPlaces(double bias, const std::array<double, PlaceEvidence::kSize>& weights) {
  std::vector<TrainingDrive> drives(3);
  for (std::uint32_t d = 0; d < 3; ++d)
    for (std::uint32_t i = 0; i < 40; ++i)
      drives[d].push_back({urban_nav_core::StampNs{i} * 1'000'000'000, syntheticPlace(1000 * d + i, 0)});
  TrainingOptions options;
  options.k_means.words = 300;
  PlaceModel model = trainModel(std::move(drives), options).model;
  model.single.bias = bias;
  model.single.weights = weights;
  model.single_sequence.reset();
  model.single.floor = 0.001;
  model.single.ceiling = 0.999;
  return model;
}

}  // namespace fabmap_node::testing
