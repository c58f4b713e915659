// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace swf_vo {

/// How long scores of landmarks count, in view change: a landmark lives for half a radian or so.
inline constexpr double kScoreMemoryRad = 10.0;  ///< generations of landmarks
/// A few generations: what a surface or a place in the image makes of all that pass there.
inline constexpr double kScoreCorrelationRad = 3.0;

/// A region of the image, by the direction (x, y) / z of what is seen there: a quarter of the depth wide and high.
using ImageRegion = std::array<int, 2>;

inline ImageRegion imageRegion(const Eigen::Vector2d& direction) {
  static constexpr double kWidth = 0.25, kWidest = 4.0;
  const auto place = [](double tangent) {
    return static_cast<int>(std::floor(std::clamp(tangent, -kWidest, kWidest) / kWidth));
  };
  return {place(direction.x()), place(direction.y())};
}

}  // namespace swf_vo
