// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace scene_labeler {

/// Turns scores of a classifier into log probabilities: log softmax(scale * score + bias).
struct Calibration {
  double scale = 1.0;
  std::vector<float> bias;  ///< one for each class

  /// Replaces scores by log probabilities, in place.
  void apply(float* scores) const;
  void archive(urban_nav_core::Archive& archive);
};

/// Scores of samples that the classifier was not fitted to.
struct HeldOutScores {
  std::size_t classes = 0;
  std::vector<float> scores;         ///< sample by sample, one for each class
  std::vector<std::uint8_t> labels;  ///< position of the class among the model's classes
  std::vector<float> weights;        ///< one per sample

  std::size_t size() const { return labels.size(); }
};

/// Fits scale and bias by the likelihood of held-out samples (Guo et al. 2017, vector scaling with one scale), with a
/// prior that keeps the bias of rare classes near 0. A class that no sample has keeps 0: one that only corrections have
/// is not less likely for being new.
Calibration fitCalibration(const HeldOutScores& samples);

/// Replaces log values by log probabilities that sum to one.
void normaliseLogs(float* logs, std::size_t count);

}  // namespace scene_labeler
