// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace scene_labeler {

/// Training samples stored in a model, so that training can be continued. Features are codes of the model's bins.
struct ModelSamples {
  std::vector<std::string> folds;     ///< names of sessions or scenes, ascending
  std::vector<std::uint8_t> codes;    ///< per sample
  std::vector<std::uint8_t> labels;   ///< one per sample: index among the classes of the model
  std::vector<std::uint8_t> weights;  ///< one per sample, at least 1
  std::vector<std::uint16_t> places;  ///< one per sample: index in `folds`
  std::vector<float> frequencies;     ///< per class of the model, number of returns in the calibration data

  std::size_t size() const { return labels.size(); }
  bool empty() const { return labels.empty(); }
  /// `columns`, `classes`: numbers of features and of classes of the model.
  void archive(urban_nav_core::Archive& archive, std::size_t columns, std::size_t classes);
};

}  // namespace scene_labeler
