// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "scene_labeler/model/label_model.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Finds a camera that is mounted upside down, or whose calibration is that of such a one: the image turned by 180 deg
/// then agrees better than the image itself with what the shape of the returns says: whether they are ground, wall,
/// foliage or something else. Not thread-safe.
class MountingCheck {
 public:
  /// The model must outlive the check.
  explicit MountingCheck(const LabelModel& model) : model_(model) {}

  /// Adds a scene with an image and its features (measureSceneFeatures()), unless enough were seen.
  void add(const Scene& scene, const FeatureTable& table);
  /// Returns whether the frames so far speak for a camera that is upside down.
  bool isUpsideDown() const { return frames_ >= kLeastFrames && evidence_ > kLeastEvidence; }
  /// Returns the mean over the returns by how much the turned image is more likely, as a difference of logarithms.
  double evidence() const { return frames_ > 0 ? evidence_ / static_cast<double>(frames_) : 0.0; }

 private:
  static constexpr std::size_t kLeastFrames = 2;  // one image alone tells nothing
  static constexpr double kLeastEvidence = 0.1;   // summed over frames; upright ones have -0.04 to -0.35 each

  const LabelModel& model_;
  double evidence_ = 0.0;  // summed over frames
  std::size_t frames_ = 0;
};

}  // namespace scene_labeler
