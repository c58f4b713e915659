// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "urban_nav_core/types/point_cloud.hpp"

namespace loop_metric {

/// Where the beams of a cloud went through, and so nothing stood: cubes of a grid around the cloud's origin, 32 m to each side and 16 m up and down
/// (occupancy grids: Moravec and Elfes 1985). Surfaces of another cloud in there speak against the pose that lays them there; where no beam came by, they say nothing.
class FreeSpace {
 public:
  /// `cloud`: with origins. `edge`: of the cubes, m; a beam leaves free what lies more than two of them before its end.
  FreeSpace(const urban_nav_core::PointCloud& cloud, float edge);

  /// Beams went through here, and none ended in the cube or beside it.
  bool isFree(const Eigen::Vector3f& point) const;

 private:
  /// Number of the cube; none outside.
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t cubeOf(const Eigen::Vector3f& point) const;
  void mark(std::size_t cube);

  float per_m_;
  std::vector<std::uint8_t>
      beams_;  ///< that went through each cube, at most `occupied` - 1; `occupied`: one ended there or beside it
};

}  // namespace loop_metric
