// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <random>
#include <string>

#include "scene_labeler/labelling/superpixels.hpp"
#include "scene_labeler/scene.hpp"
#include "scene_labeler/training/train.hpp"

namespace scene_labeler::testing {

/// Paved ground at z = 0 with a wall at x = 8 m and bushes, without an image.
struct Yard {
  Scene scene;
  std::vector<SceneClass> labels;

  void add(const Eigen::Vector3f& point, SceneClass label) {
    scene.points.push_back(point);
    labels.push_back(label);
  }
};

inline Yard makeYard(unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&random](float low, float high) {
    return low + (high - low) * static_cast<float>(random() % 10000U) / 1e4F;
  };
  Yard yard;
  yard.scene.name = "yard" + std::to_string(seed);
  for (int i = 0; i < 4000; ++i) yard.add({draw(0, 8), draw(0, 8), draw(-0.02F, 0.02F)}, SceneClass::Paved);
  for (int i = 0; i < 3000; ++i) yard.add({8 + draw(-0.02F, 0.02F), draw(0, 8), draw(0.2F, 3)}, SceneClass::Wall);
  for (int bush = 0; bush < 4; ++bush) {
    const float x = draw(1, 6), y = draw(1, 7);
    for (int i = 0; i < 500; ++i)
      yard.add({x + draw(-0.6F, 0.6F), y + draw(-0.6F, 0.6F), draw(0.3F, 1.6F)}, SceneClass::Foliage);
  }
  return yard;
}

inline std::vector<TrainingFold> yardFolds(FeatureSet features) {
  std::vector<TrainingFold> folds;
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Yard yard = makeYard(seed);
    addScene({yard.scene.name, measureFeatures(yard.scene, features), yard.labels, makePatches(yard.scene, {})}, {},
             folds);
  }
  return folds;
}

/// Trained once for all tests of a program.
inline const LabelModel& trainOnYards(ClassifierKind kind, FeatureSet features = FeatureSet::All) {
  static std::map<std::pair<ClassifierKind, FeatureSet>, LabelModel> models;
  const auto found = models.find({kind, features});
  if (found != models.end()) return found->second;
  TrainingOptions options;
  options.kind = kind;
  options.features = features;
  options.samples_per_class = 300;
  const auto trained = trainModel(yardFolds(features), options, [](double) {});
  return models.emplace(std::make_pair(kind, features), trained.model).first->second;
}

}  // namespace scene_labeler::testing
