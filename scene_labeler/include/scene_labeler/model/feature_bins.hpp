// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace scene_labeler {

/// Quantises the values of features, so that trees compare bytes.
class FeatureBins {
 public:
  /// Codes of a value: 0 is missing, 1 is below the first edge, `kCodeCount` - 1 is above the last edge of 63.
  static constexpr std::size_t kCodeCount = 65;

  FeatureBins() = default;
  /// Chooses edges at quantiles of the samples (`rows` of `columns` values each).
  FeatureBins(const std::vector<float>& values, std::size_t columns);

  std::size_t columns() const { return edges_.size(); }
  std::uint8_t code(std::size_t column, float value) const;
  /// Writes one code per value of a row.
  void encode(const float* row, std::uint8_t* codes) const;
  /// Returns a value with this code; NaN for 0.
  float decode(std::size_t column, std::uint8_t code) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  std::vector<std::vector<float>> edges_;  // per column, ascending, at most kCodeCount - 2
};

}  // namespace scene_labeler
