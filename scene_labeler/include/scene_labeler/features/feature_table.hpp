// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace scene_labeler {

/// Value of a feature that could not be measured.
constexpr float kMissingFeature = std::numeric_limits<float>::quiet_NaN();

/// Features of the returns of a scene, one row per return. Missing values are NaN; all others are finite.
struct FeatureTable {
  std::vector<std::string> names;
  std::vector<float> values;  ///< row by row

  std::size_t columns() const { return names.size(); }
  std::size_t rows() const { return names.empty() ? 0 : values.size() / names.size(); }
  const float* row(std::size_t i) const { return values.data() + i * columns(); }
  float* row(std::size_t i) { return values.data() + i * columns(); }
};

}  // namespace scene_labeler
