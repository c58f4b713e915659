// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene_labeler/classes.hpp"
#include "scene_labeler/features/feature_table.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Labelled scene with its features.
struct TrainingScene {
  std::string fold;  ///< session or scene, never split between folds
  FeatureTable features;
  std::vector<SceneClass> labels;      ///< one per return; None is ignored
  std::vector<std::uint32_t> patches;  ///< from makePatches()
};

/// Returns of one fold, with their features.
struct FoldRows {
  std::vector<float> values;           ///< row by row
  std::vector<SceneClass> labels;      ///< one per row
  std::vector<std::uint32_t> patches;  ///< one per row; unique within the fold
  std::vector<float> weights;          ///< one per row
};

/// Training data of one fold: samples for the classifier, evenly subsampled per class, and whole patches with their
/// natural frequencies for calibration.
struct TrainingFold {
  std::string name;
  FoldRows samples, held_out;
};

/// Limits of the data kept per scene.
struct SamplingLimits {
  std::size_t samples_per_class = 2000;  ///< per scene
  std::size_t held_out = 12000;          ///< per scene
};

/// Draws the training data of a scene, deterministically, and adds them to the fold of its name.
void addScene(const TrainingScene& scene, const SamplingLimits& limits, std::vector<TrainingFold>& folds);

/// Adds a fold, or merges its data into the fold of its name.
void mergeFold(TrainingFold fold, std::vector<TrainingFold>& folds);

/// Adds a single scene as two folds, NAME/1 and NAME/2, split at the middle of its longer horizontal extent, so that
/// calibration uses data to which the classifier was not fitted, although of the same place. Requires labels of None
/// for points that are not finite.
void addHalves(const TrainingScene& training, const Scene& scene, const SamplingLimits& limits,
               std::vector<TrainingFold>& folds);

}  // namespace scene_labeler
