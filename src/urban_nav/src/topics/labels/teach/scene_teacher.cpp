// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/teach/scene_teacher.hpp"

#include <algorithm>

#include "scene_labeler/training/teaching.hpp"

namespace urban_nav {

using scene_labeler::LabelModel;
using scene_labeler::SceneClass;
using scene_labeler::SceneLabels;

SceneTeacher::SceneTeacher(LabelModel base, const std::string& model_name, scene_labeler::Scene scene,
                           const Options& options)
    : base_(std::move(base)), scene_(std::move(scene)), options_(options) {
  requireSamples(base_, model_name);
  features_ = scene_labeler::measureSceneFeatures(base_, scene_);
  answer_ = scene_labeler::labelScene(base_, scene_, options_.training.superpixel, features_);
}

LabelModel SceneTeacher::teach(const std::vector<SceneClass>& labels) const {
  std::vector<scene_labeler::TrainingFold> folds = scene_labeler::restoreFolds(base_);
  const auto count =
      scene_labeler::addCorrections(base_, features_, answer_, labels, correctionsFold(options_.name, folds), folds);
  if (count.corrected == 0) return base_;
  return trainWithCorrections(base_, std::move(folds), options_.training);
}

SceneLabels SceneTeacher::answer(const std::vector<SceneClass>& labels) const {
  SceneLabels answer = scene_labeler::labelScene(teach(labels), scene_, options_.training.superpixel, features_);
  keepCorrections(labels, answer);
  return answer;
}

void keepCorrections(const std::vector<SceneClass>& corrected, SceneLabels& answer) {
  const bool has_one_wall =
      std::find(answer.classes.begin(), answer.classes.end(), SceneClass::Wall) != answer.classes.end();
  const std::size_t classes = answer.classes.size();
  for (std::size_t i = 0; i < corrected.size(); ++i) {
    const SceneClass label = has_one_wall ? withOneWall(corrected[i]) : corrected[i];
    const auto known = std::find(answer.classes.begin(), answer.classes.end(), label);
    if (label == SceneClass::None || known == answer.classes.end() || answer.labels[i] == SceneClass::None) continue;
    answer.labels[i] = label;
    answer.unsure[i] = 0;
    const auto first = answer.probabilities.begin() + static_cast<std::ptrdiff_t>(i * classes);
    std::fill(first, first + static_cast<std::ptrdiff_t>(classes), 0.0F);
    *(first + (known - answer.classes.begin())) = 1.0F;
  }
}

}  // namespace urban_nav
