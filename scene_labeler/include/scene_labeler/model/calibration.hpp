// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace scene_labeler {

/// Converts scores of a classifier to log probabilities: log softmax(scale * score + bias).
struct Calibration {
  double scale = 1.0;
  std::vector<float> bias;  ///< one per class

  /// Replaces scores by log probabilities, in place.
  void apply(float* scores) const;
  void archive(urban_nav_core::Archive& archive);
};

/// Scores of samples that were not used to fit the classifier.
struct HeldOutScores {
  std::size_t classes = 0;
  std::vector<float> scores;         ///< per sample and class
  std::vector<std::uint8_t> labels;  ///< index among the model's classes
  std::vector<float> weights;        ///< one per sample

  std::size_t size() const { return labels.size(); }
};

/// Fits scale and bias by maximum likelihood on held-out samples (Guo et al. 2017, vector scaling with one scale), with
/// a prior that keeps the bias of rare classes near 0. A class without samples keeps 0: a class that occurs only in
/// corrections must not be penalised for being new.
Calibration fitCalibration(const HeldOutScores& samples);

/// Replaces log values by log probabilities that sum to one.
void normaliseLogs(float* logs, std::size_t count);

}  // namespace scene_labeler
