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
  std::size_t right = 0, wrong = 0;  ///< numbers of calibration samples of each kind
};
/// A trained place model with the report of its training.
struct TrainedModel {
  PlaceModel model;
  TrainingReport report;
};

/// Trains vocabulary, Chow-Liu tree, sampled places and calibration. Observations of a stationary camera are used once.
///
/// Calibration: each observation is compared with the others of its drive (neighbours are the same place) and with
/// those of another drive (never the same place), with trees and sampled places of the remaining drives. Fewer than
/// three drives are divided into parts that serve as drives. Places further along the same street are samples of
/// different places. Without drives of single images, the first camera of panoramas calibrates single images.
/// `progress`: name of the step, share done. Throws UserError if there are too few data.
TrainedModel trainModel(std::vector<TrainingDrive> drives, const TrainingOptions& options,
                        const std::function<void(const std::string& step, double share)>& progress = {});

}  // namespace fabmap_node
