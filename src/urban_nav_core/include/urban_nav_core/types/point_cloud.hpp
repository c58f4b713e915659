// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace urban_nav_core {

/// Points of one frame, m, as a device or a file gave them: some may hold NaN (a beam without return), none is left
/// out.
struct PointCloud {
  std::vector<Eigen::Vector3f> points;
  /// Where the beam of each point came from, m, in the frame of the points; empty where that is not known.
  std::vector<Eigen::Vector3f> origins;
};

}  // namespace urban_nav_core
