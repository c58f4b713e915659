// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "scene_labeler/model/label_model.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Detects a camera that is mounted upside down, or has the calibration of such a camera: the image rotated by 180 deg
/// then agrees better than the image itself with the classification of the returns by shape as ground, wall, foliage or
/// other. Not thread-safe.
class MountingCheck {
 public:
  /// The model must outlive the check.
  explicit MountingCheck(const LabelModel& model) : model_(model) {}

  /// Adds a scene with an image and its features (measureSceneFeatures()), unless enough were added.
  void add(const Scene& scene, const FeatureTable& table);
  /// Returns whether the frames so far indicate an upside-down camera.
  bool isUpsideDown() const { return frames_ >= kLeastFrames && evidence_ > kLeastEvidence; }
  /// Returns the mean log likelihood ratio, over the returns, of the rotated to the original image.
  double evidence() const { return frames_ > 0 ? evidence_ / static_cast<double>(frames_) : 0.0; }

 private:
  static constexpr std::size_t kLeastFrames = 2;  // one image is not sufficient
  static constexpr double kLeastEvidence = 0.1;   // summed over frames; upright images have -0.04 to -0.35 each

  const LabelModel& model_;
  double evidence_ = 0.0;  // summed over frames
  std::size_t frames_ = 0;
};

}  // namespace scene_labeler
