// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene_labeler/model/label_model.hpp"
#include "scene_labeler/training/training_data.hpp"

namespace scene_labeler {

/// Weight of a corrected return; that of others is 1.
constexpr float kCorrectionWeight = 10.0F;
/// Weight of a return that stays what the model says it is, since nobody corrected it; it is learnt by trees that are
/// added to those of the model, and not kept.
constexpr float kAnchorWeight = 0.5F;

/// Returns the samples that a model holds as training data, fold by fold: samples of weight 1 also serve calibration,
/// in the frequencies of the data that the model was calibrated on. Empty if the model holds none.
std::vector<TrainingFold> restoreFolds(const LabelModel& model);

/// Number of returns that were compared with a model, and of those that differ from its answer.
struct CorrectionCount {
  std::size_t labelled = 0, corrected = 0;
};

/// Adds the returns of a scene whose label differs from the answer of the model as a fold of its own, with
/// kCorrectionWeight; labels that equal the answer are not learnt. `labels`: one per return, None is no label; kinds of
/// wall are one class for a model that does not distinguish them. Requires a fold name that `folds` does not hold.
CorrectionCount addCorrections(const LabelModel& model, const Scene& scene, std::vector<SceneClass> labels,
                               int superpixel_size, const std::string& fold, std::vector<TrainingFold>& folds);

/// A return of a scene and the class that a person gave to the superpixel there.
struct PatchCorrection {
  std::size_t point = 0;  ///< index in the scene
  SceneClass label = SceneClass::None;
};

/// Adds the returns of the superpixels of a scene at the given returns (without an image: of the cubes of
/// makePatches()) to a fold, whatever the model's answer is, with weights by which all superpixels count about the
/// same: one return of the smallest has kCorrectionWeight in a kind of place that the model was not trained in. In
/// others, where most answers are right, it has less, and 300 returns or fewer of the scene are added with
/// kAnchorWeight, of classes that nobody took from the model here. Returns how many corrected returns were added.
std::size_t addPatchCorrections(const LabelModel& model, const Scene& scene,
                                const std::vector<PatchCorrection>& corrections, int superpixel_size,
                                TrainingFold& fold);

}  // namespace scene_labeler
