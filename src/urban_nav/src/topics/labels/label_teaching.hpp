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
