// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "urban_nav_core/types/point_cloud.hpp"

namespace urban_nav_registration {

/// Free space observed by the beams of a cloud: cubes of a grid around its origin, 32 m to each side and 16 m up and
/// down (occupancy grids: Moravec and Elfes 1985). Surfaces of another cloud in free space contradict its pose;
/// unobserved space is neutral. Immutable, so thread-safe.
class FreeSpace {
 public:
  /// Requires a cloud with origins. `edge`: edge length of the cubes, m; a beam frees the space up to two cubes before
  /// its end.
  FreeSpace(const urban_nav_core::PointCloud& cloud, float edge);

  /// Returns true if beams passed through the cube of the point, and no beam ended in it or in an adjacent cube.
  bool isFree(const Eigen::Vector3f& point) const;

 private:
  /// Index of the cube; `kNone` outside the grid.
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t findCube(const Eigen::Vector3f& point) const;
  void mark(std::size_t cube);

  float per_m_;
  std::vector<std::uint8_t> beams_;  ///< number of beams through each cube, at most `occupied` - 1; `occupied`: a beam
                                     ///< ended there or in an adjacent cube
};

}  // namespace urban_nav_registration
