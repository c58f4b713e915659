// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// Detects patches that contain two surfaces. At the edge of a near object, left and right image show different
/// backgrounds, and the disparity of the patch belongs to neither surface: its residual is larger than the noise of the
/// image explains. The threshold follows the residuals of recent patches (robust_threshold.hpp).
class PatchResidualTest {
 public:
  /// Returns whether a residual (standard deviation, grey levels) is below the threshold, and adds it to the recent
  /// residuals. Returns true while there are too few of them.
  bool isTypical(double noise);
  void archive(urban_nav_core::Archive& archive);

 private:
  static constexpr std::size_t kSize = 64, kEnough = 16;
  std::array<double, kSize> recent_{}, sorted_{};
  std::size_t count_ = 0;
  double limit_ = 0.0;
};

}  // namespace swf_vo
