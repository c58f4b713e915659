// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/recognition/place_matcher.hpp"
#include "fabmap_node/vocabulary/k_means.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace fabmap_node {
/// An observation of a training drive.
struct TrainingImage {
  urban_nav_core::StampNs stamp = 0;
  PlaceObservation observation;
};
/// Observations of one drive in order of time. Drives should be at different places.
using TrainingDrive = std::vector<TrainingImage>;
/// Options of the training of a place model.
struct TrainingOptions {
  KMeansOptions k_means;
  MatcherOptions matcher;
  std::size_t sampled_places = 400;  ///< limit of the number of observations stored for the likelihood of new places
};
/// Sizes of a training run.
struct TrainingReport {
  std::size_t observations = 0, stationary = 0, descriptors = 0;
};
/// A trained place model with the report of its training.
struct TrainedModel {
  PlaceModel model;
  TrainingReport report;
};

/// Trains vocabulary, Chow-Liu tree and sampled places. Observations of a stationary camera are used once. The
/// calibrations are those of useSuppliedCalibrations(): which images of drives without positions show one place is not
/// known, and neighbours may be centimetres or tens of metres apart; recalibrate() fits others. `progress`: name of
/// the step, share done. Throws UserError if there are too few data.
TrainedModel trainModel(std::vector<TrainingDrive> drives, const TrainingOptions& options,
                        const std::function<void(const std::string& step, double share)>& progress = {});

}  // namespace fabmap_node
