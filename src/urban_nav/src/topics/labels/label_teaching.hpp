// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/console.hpp"
#include "scene_labeler/class_map.hpp"
#include "scene_labeler/training/teaching.hpp"
#include "topics/labels/label_sources.hpp"

namespace urban_nav {

/// Throws UserError for a model without training samples, which cannot be taught. `name`: of the model.
void requireSamples(const scene_labeler::LabelModel& model, const std::string& name);

/// Corrections of one scene, from a file with edited labels.
struct SceneCorrections {
  std::string name;  ///< of the file, without extension
  SceneFiles files;  ///< of the scene: the file itself, or the one with an image that its header names
  SceneInput input;
  std::vector<scene_labeler::SceneClass> labels;  ///< one per point; None: no correction

  /// Returns whether these are corrections of a scene: the same points in the same order.
  bool describes(const SceneInput& scene) const;
};

/// Reads an edited scene. Warns if its header names a scene with an image that no longer exists. Throws UserError for a
/// file without labels or with an unknown one.
SceneCorrections readSceneCorrections(const std::string& path, const scene_labeler::ClassMap& map, Console& console);

/// Returns the name of the training fold of the corrections in a file, unlike those of `folds`.
std::string correctionsFold(const std::string& name, const std::vector<scene_labeler::TrainingFold>& folds);

/// Options of the training by corrections.
struct CorrectionTraining {
  int superpixel = 12;                   ///< px, scene_labeler.superpixel
  std::size_t samples_per_class = 3000;  ///< scene_labeler.samples
  std::uint64_t seed = 1;                ///< --seed of train
};

/// Returns a model with trees added for the last of `folds`, the corrections; the others are those of restoreFolds().
scene_labeler::LabelModel trainWithCorrections(const scene_labeler::LabelModel& base,
                                               std::vector<scene_labeler::TrainingFold> folds,
                                               const CorrectionTraining& options);

/// Returns the model taught by a file of corrections, as `labels train --add MODEL --corrections FILE` does. Throws
/// UserError for a model without samples, DataError if nothing is corrected. `name`: of the model.
scene_labeler::LabelModel teachByCorrections(const scene_labeler::LabelModel& base, const std::string& name,
                                             const SceneCorrections& corrections, const CorrectionTraining& options);

/// Input of `labels train` from a model and from manual corrections.
class LabelTeaching {
 public:
  /// Reads the options --add, --corrections and --features. Throws UserError for a file that is not a model, a
  /// model without samples or with other features, corrections without a model, and a command without training data.
  explicit LabelTeaching(const Arguments& arguments);

  /// Returns whether there is neither SRC nor a correction: the classifier of the model is kept, and its thresholds of
  /// sure labels are determined from its samples.
  bool keepsClassifier() const { return keeps_classifier_; }
  /// Returns the model that training continues from; nullptr without --add.
  const scene_labeler::LabelModel* base() const { return base_ ? &*base_ : nullptr; }
  scene_labeler::FeatureSet features() const { return features_; }
  /// Returns the device of the reflectance in the model and the sources together.
  std::string device(const LabelSources& sources) const;
  /// Returns the samples of the model; empty without --add.
  std::vector<scene_labeler::TrainingFold> folds() const;
  /// Adds the corrections to `folds`: an edited scene, or clicks in bags (LabelClicks). Throws UserError for a file
  /// without labels or with an unknown one, DataError if nothing is corrected.
  void addCorrections(const scene_labeler::ClassMap& map, const DriveOptions& options, Console& console,
                      std::vector<scene_labeler::TrainingFold>& folds) const;

 private:
  void addClicks(const DriveOptions& options, Console& console, std::vector<scene_labeler::TrainingFold>& folds) const;

  std::optional<scene_labeler::LabelModel> base_;
  scene_labeler::FeatureSet features_ = scene_labeler::FeatureSet::All;
  std::string corrections_;
  bool keeps_classifier_ = false;
};

}  // namespace urban_nav
