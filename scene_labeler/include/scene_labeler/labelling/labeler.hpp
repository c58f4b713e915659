// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene_labeler/model/label_model.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Labels of the returns of one scene.
struct SceneLabels {
  std::vector<SceneClass> classes;     ///< classes of the model; columns of `probabilities`
  std::vector<SceneClass> labels;      ///< one per return; None: no label
  std::vector<float> probabilities;    ///< per return and class; they sum to one, or are 0 without a label
  std::vector<std::uint8_t> unsure;    ///< 1: unlike the training data, or less probable than the threshold for the
                                       ///< model's precision (sure_rule.hpp)
  std::vector<std::uint32_t> patches;  ///< from makePatches()
  double share_unlike = 0.0;           ///< of PlaceNovelty, for doubtKinds()
  cv::Mat image;  ///< CV_8U, class of each superpixel, 255 without laser returns; empty without image

  float probability(std::size_t i) const;
};

/// Labels every return of a scene: single returns by the classifier, then the returns of each superpixel jointly.
/// Deterministic for any number of threads. `superpixel_size`: px. Thread-safe.
SceneLabels labelScene(const LabelModel& model, const Scene& scene, int superpixel_size);

/// Labels a scene from precomputed features (measureSceneFeatures() of the model).
SceneLabels labelScene(const LabelModel& model, const Scene& scene, int superpixel_size, const FeatureTable& table);

/// Returns the features of a scene for a model: without the reflectance of another device.
FeatureTable measureSceneFeatures(const LabelModel& model, const Scene& scene);

}  // namespace scene_labeler
