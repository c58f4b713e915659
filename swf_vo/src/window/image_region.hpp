// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace swf_vo {

/// Memory of landmark scores, in view change: the life of a landmark is about 0.5 rad.
inline constexpr double kScoreMemoryRad = 10.0;  ///< generations of landmarks
/// Correlation length, a few generations: errors of a surface or a position in the image affect all landmarks there.
inline constexpr double kScoreCorrelationRad = 3.0;

/// A region of the image in terms of the direction (x, y) / z; width and height are a quarter of the depth.
using ImageRegion = std::array<int, 2>;

inline ImageRegion imageRegion(const Eigen::Vector2d& direction) {
  static constexpr double kWidth = 0.25, kWidest = 4.0;
  const auto place = [](double tangent) {
    return static_cast<int>(std::floor(std::clamp(tangent, -kWidest, kWidest) / kWidth));
  };
  return {place(direction.x()), place(direction.y())};
}

}  // namespace swf_vo
