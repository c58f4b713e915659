// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace urban_nav_core {

/// Points of one frame, m, in the order of the device or file. None is omitted: points without a return contain NaN.
struct PointCloud {
  std::vector<Eigen::Vector3f> points;
  /// Origin of each point's beam, m, in the frame of the points; empty if unknown.
  std::vector<Eigen::Vector3f> origins;
};

}  // namespace urban_nav_core
