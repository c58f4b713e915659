// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene_labeler/model/svm_bank.hpp"

namespace scene_labeler {

/// Samples with values of features, missing ones NaN.
struct ValueSamples {
  std::size_t features = 0, classes = 0;
  std::vector<float> values;
  std::vector<std::uint8_t> labels;
  std::vector<std::uint8_t> is_ground;       ///< per class
  std::vector<std::uint8_t> ground_columns;  ///< height above ground, vertical component of the normal
};

struct SvmSettings {
  double c = 10.0;
  double gamma = 1.0;  ///< divided by the number of features
};

/// Trains a bank of machines by OpenCV's implementation of C-support vector classification.
SvmBank trainSvmBank(const ValueSamples& samples, const SvmSettings& settings);

}  // namespace scene_labeler
