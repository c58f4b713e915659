// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// Tells patches that are two surfaces from those that are one. At the edge of something near, left and right image show different
/// backgrounds, and the disparity in between belongs to neither: such a patch leaves a larger residual than the noise of the image
/// explains. What is usual is learnt from the patches themselves: the median of the last ones and its median deviation.
class Misfit {
 public:
  /// Is a residual (standard deviation, grey levels) as it usually is? True while too few are known. Counts it.
  bool isUsual(double noise);
  void archive(urban_nav_core::Archive& archive);

 private:
  static constexpr std::size_t size = 64, enough = 16;
  std::array<double, size> recent_{}, sorted_{};
  std::size_t count_ = 0;
  double limit_ = 0.0;
};

}  // namespace swf_vo
