// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "scene_labeler/model/label_model.hpp"
#include "scene_labeler/training/training_data.hpp"

namespace scene_labeler {
/// Options of the training of a label model.
struct TrainingOptions {
  ClassifierKind kind = ClassifierKind::Boosted;
  FeatureSet features = FeatureSet::All;
  std::size_t samples_per_class = 3000;  ///< over all folds
  std::uint64_t seed = 1;
  std::string device = {};  ///< device of the reflectance in the folds, as in Scene::device
  /// Model from which training continues, with its samples among the folds (restoreFolds()): the ranges of its features
  /// are kept, and its fusion of patches if no fold has patches.
  const LabelModel* base = nullptr;
  /// Adds trees to those of a boosted base, whose calibration is kept, instead of training from scratch; for folds that
  /// only add corrections. A model stores fewer samples than it was trained with.
  bool adds_trees = false;
};

/// Values of settings compared by cross-validation.
struct ValidatedSetting {
  std::vector<std::pair<std::string, double>> values;
  double f1_mean = 0.0;  ///< over the classes of the held-out folds
};
/// A trained label model with its cross-validation.
struct TrainedModel {
  LabelModel model;
  std::vector<std::pair<SceneClass, std::size_t>> samples;  ///< number per class
  std::size_t folds = 0;
  std::vector<ValidatedSetting> cross_validation;  ///< empty if trees were added to a base
  std::size_t chosen = 0;                          ///< index in cross_validation
};

/// Trains a classifier: settings by cross-validation over folds, calibration on the held-out folds. `progress`: share
/// of the work done. Deterministic for any number of threads and any order of folds. Throws DataError if there are
/// fewer than two classes.
TrainedModel trainModel(std::vector<TrainingFold> folds, const TrainingOptions& options,
                        const std::function<void(double)>& progress);

}  // namespace scene_labeler
