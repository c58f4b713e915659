// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace scene_labeler {

/// Support vector machine with a Gaussian kernel: sum of weights times exp(-gamma |x - v|^2), minus rho.
struct KernelMachine {
  double gamma = 1.0, rho = 0.0;
  std::vector<float> vectors;  ///< support vectors, one after another
  std::vector<float> weights;  ///< one per vector; positive for the class, negative against it

  double evaluate(const float* features, std::size_t size) const;
  void archive(urban_nav_core::Archive& archive);
};

/// One machine for each class, each against all others of its group (Newman et al. 2009, section 8.2). Scores are
/// logarithms of the logistic function of the margin; Calibration turns them into probabilities. Ground and other
/// classes are groups of their own, divided by a normal distribution of height and normal (Bayes decision rule).
struct SvmBank {
  std::vector<float> means, inverse_deviations;  ///< of the features: 0 and 1 after the transform; missing ones are 0
  std::vector<KernelMachine> machines;           ///< one per class
  std::vector<std::uint8_t> is_ground;           ///< of each class
  std::vector<float> ground_moments;         ///< for ground, then for the rest: mean and deviation of height, normal
  std::vector<std::uint8_t> ground_columns;  ///< columns of height over ground and vertical part of the normal
  double ground_prior = 0.5;

  /// Writes one log score for each class.
  void evaluate(const float* row, float* scores) const;
  void archive(urban_nav_core::Archive& archive, std::size_t features, std::size_t classes);
};

}  // namespace scene_labeler
