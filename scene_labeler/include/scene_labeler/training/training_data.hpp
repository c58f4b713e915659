// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene_labeler/classes.hpp"
#include "scene_labeler/features/feature_table.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// A scene with labels, measured.
struct TrainingScene {
  std::string fold;  ///< session or scene: neighbours are never divided between folds
  FeatureTable features;
  std::vector<SceneClass> labels;      ///< one per return; None does not count
  std::vector<std::uint32_t> patches;  ///< of makePatches()
};

/// Returns of one class or patch in one fold, with their features.
struct FoldRows {
  std::vector<float> values;           ///< row by row
  std::vector<SceneClass> labels;      ///< one per row
  std::vector<std::uint32_t> patches;  ///< one per row; unique within the fold
  std::vector<float> weights;          ///< one per row
};

/// Training data of one fold: samples for the classifier, evenly drawn from each class, and whole patches in their
/// natural frequencies for calibration.
struct TrainingFold {
  std::string name;
  FoldRows samples, held_out;
};

/// Bounds of what is kept of a scene.
struct SamplingLimits {
  std::size_t samples_per_class = 2000;  ///< of each scene
  std::size_t held_out = 12000;          ///< of each scene
};

/// Draws the training data of a scene, the same ones for the same scene. Adds to the fold of its name.
void addScene(const TrainingScene& scene, const SamplingLimits& limits, std::vector<TrainingFold>& folds);

/// Adds a fold, or its data to the fold of its name.
void mergeFold(TrainingFold fold, std::vector<TrainingFold>& folds);

/// Adds a scene that is the only one as two folds, NAME/1 and NAME/2, divided at the middle of its longer horizontal
/// extent: calibration then has data that the classifier was not fitted to, although of the same place. Requires
/// labels of None for points that are not finite.
void addHalves(const TrainingScene& training, const Scene& scene, const SamplingLimits& limits,
               std::vector<TrainingFold>& folds);

}  // namespace scene_labeler
