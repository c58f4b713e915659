// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene_labeler/labelling/labeler.hpp"
#include "scene_labeler/model/label_model.hpp"
#include "scene_labeler/training/training_data.hpp"

namespace scene_labeler {

/// Weight of a corrected return; that of others is 1.
constexpr float kCorrectionWeight = 10.0F;
/// Weight of an uncorrected return, for which the model's answer is kept as target; used by trees that are added to
/// those of the model, and not stored.
constexpr float kAnchorWeight = 0.5F;

/// Returns the samples stored in a model as training data, by fold: samples of weight 1 are also used for calibration,
/// with the frequencies of the data on which the model was calibrated. Empty if the model has no samples.
std::vector<TrainingFold> restoreFolds(const LabelModel& model);

/// Numbers of returns compared with a model, and of those that differ from its answer.
struct CorrectionCount {
  std::size_t labelled = 0, corrected = 0;
};

/// Adds the returns of a scene whose label differs from the answer of the model as a new fold, with kCorrectionWeight;
/// labels equal to the answer are not used. `labels`: one per return, None is not a label; kinds of wall are one class
/// for a model that does not distinguish them. Requires a fold name that is not in `folds`.
CorrectionCount addCorrections(const LabelModel& model, const Scene& scene, std::vector<SceneClass> labels,
                               int superpixel_size, const std::string& fold, std::vector<TrainingFold>& folds);

/// Adds corrections of a scene whose features (measureSceneFeatures()) and answers (labelScene() of the model) are
/// known.
CorrectionCount addCorrections(const LabelModel& model, const FeatureTable& table, const SceneLabels& answer,
                               std::vector<SceneClass> labels, const std::string& fold,
                               std::vector<TrainingFold>& folds);

/// Return of a scene and the class that a user assigned to its superpixel.
struct PatchCorrection {
  std::size_t point = 0;  ///< index in the scene
  SceneClass label = SceneClass::None;
};

/// Adds the returns of the superpixels of a scene at the given returns (without an image: of the cubes of
/// makePatches()) to a fold, regardless of the model's answer, with weights that make all superpixels count about
/// equally: one return of the smallest has kCorrectionWeight in a kind of place without training data. In others, where
/// most answers are right, the weight is smaller, and up to 300 returns of the scene are added with kAnchorWeight, of
/// classes that were not corrected there. Returns the number of corrected returns added.
std::size_t addPatchCorrections(const LabelModel& model, const Scene& scene,
                                const std::vector<PatchCorrection>& corrections, int superpixel_size,
                                TrainingFold& fold);

}  // namespace scene_labeler
