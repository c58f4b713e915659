// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace scene_labeler {

/// Support vector machine with a Gaussian kernel: sum of weights times exp(-gamma |x - v|^2), minus rho.
struct KernelMachine {
  double gamma = 1.0, rho = 0.0;
  std::vector<float> vectors;  ///< support vectors, one after another
  std::vector<float> weights;  ///< one per vector; positive for the class, negative for others

  double evaluate(const float* features, std::size_t size) const;
  void archive(urban_nav_core::Archive& archive);
};

/// One machine per class, against all others of its group (Newman et al. 2009, section 8.2). Scores are logarithms of
/// the logistic function of the margin; Calibration converts them to probabilities. Ground and other classes are two
/// groups, separated by a normal distribution of height and normal (Bayes decision rule).
struct SvmBank {
  std::vector<float> means, inverse_deviations;  ///< of the features, to mean 0 and deviation 1; missing ones are 0
  std::vector<KernelMachine> machines;           ///< one per class
  std::vector<std::uint8_t> is_ground;           ///< of each class
  std::vector<float> ground_moments;         ///< for ground, then for the rest: mean and deviation of height and normal
  std::vector<std::uint8_t> ground_columns;  ///< columns of height above ground and vertical component of the normal
  double ground_prior = 0.5;

  /// Writes one log score per class.
  void evaluate(const float* row, float* scores) const;
  void archive(urban_nav_core::Archive& archive, std::size_t features, std::size_t classes);
};

}  // namespace scene_labeler
