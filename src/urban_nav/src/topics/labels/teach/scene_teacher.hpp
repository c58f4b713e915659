// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene_labeler/labelling/labeler.hpp"
#include "topics/labels/label_teaching.hpp"

namespace urban_nav {

/// A model that is taught by corrections of one scene, whose features are measured once. Its answers are those of
/// `labels train --add MODEL --corrections FILE` and `labels apply` with the resulting model, with the same seed and
/// parameters. Thread-safe.
class SceneTeacher {
 public:
  struct Options {
    std::string name = "scene";  ///< of the file of corrections, without extension
    CorrectionTraining training;
  };

  /// Throws UserError for a model without training samples.
  SceneTeacher(scene_labeler::LabelModel base, const std::string& model_name, scene_labeler::Scene scene,
               const Options& options);

  const scene_labeler::Scene& scene() const { return scene_; }
  const scene_labeler::LabelModel& base() const { return base_; }
  const scene_labeler::FeatureTable& features() const { return features_; }
  /// Returns the answers of the model before any correction.
  const scene_labeler::SceneLabels& answer() const { return answer_; }
  /// Returns the model taught by labels of points; None: no correction. The base if they correct nothing.
  scene_labeler::LabelModel teach(const std::vector<scene_labeler::SceneClass>& labels) const;
  /// Returns the answers of the taught model; corrected points have their class, with probability 1.
  scene_labeler::SceneLabels answer(const std::vector<scene_labeler::SceneClass>& labels) const;

 private:
  scene_labeler::LabelModel base_;
  scene_labeler::Scene scene_;
  Options options_;
  scene_labeler::FeatureTable features_;
  scene_labeler::SceneLabels answer_;
};

/// Assigns to corrected points their class with probability 1, and not unsure. A class that the model does not know,
/// and None, leave an answer as it is.
void keepCorrections(const std::vector<scene_labeler::SceneClass>& corrected, scene_labeler::SceneLabels& answer);

}  // namespace urban_nav
