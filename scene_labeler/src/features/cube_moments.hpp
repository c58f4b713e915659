// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "urban_nav_registration/cloud/cell_table.hpp"

namespace scene_labeler {

/// Moments of points relative to their own origin.
struct Moments {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();
  double count = 0.0;

  void add(const Eigen::Vector3d& point, double weight);
  void add(const Moments& other);
  void subtract(const Moments& other);
  /// Returns the moments with the weight of one point.
  Moments normalised() const { return {sum / count, outer / count, 1.0}; }
  Eigen::Vector3d mean() const { return sum / count; }
  Eigen::Matrix3d covariance() const;
};

/// Points in cubes of one size, in which each of the next smaller cubes has equal weight, so that the density of the
/// beams has no influence.
struct CubeLevel {
  float edge = 0.0F;  ///< m
  urban_nav_registration::CellTable table{16};
  std::vector<std::uint64_t> keys;  ///< per cube
  std::vector<Moments> cubes;
  std::vector<std::uint32_t> cube_of;  ///< per point; CellTable::none for points that are not finite
};

/// Cubes of 0.1, 0.2 and 0.4 m, of FeatureSet::All. A neighbourhood of 2.4 m (cubes of 0.8 m) or more describes the
/// layout of the few training places rather than the surface.
constexpr std::size_t kShapeLevels = 3;
/// Cubes up to 1.6 m, for clouds in which smaller ones around a return hold nothing else (FeatureSet::Cloud).
constexpr std::size_t kCubeLevels = 5;
constexpr float kFinestCube = 0.1F;  ///< m

using CubeLevels = std::array<CubeLevel, kCubeLevels>;

/// Returns the cell of a key.
urban_nav_registration::Cell cellOfKey(std::uint64_t key);
/// Returns the key of the cube of the next level that contains the cube of a key.
std::uint64_t coarserKey(std::uint64_t key);

/// Assigns points to cubes of all levels, relative to `origin`.
CubeLevels makeCubeLevels(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& origin);

/// Returns the mean of values over each cube of a level, in which each of the next smaller cubes has equal weight.
/// `values`: one per point; NaN values are ignored, and the mean of a cube without others is NaN.
std::vector<float> meanOverCubes(const CubeLevels& levels, std::size_t level, const std::vector<float>& values);

/// Calls take(cube) for a cube and each of its existing neighbours, up to 26.
template <typename Take>
void forEachNeighbour(const CubeLevel& level, std::uint64_t key, const Take& take) {
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const std::uint32_t cube = level.table.find(urban_nav_registration::keyBeside(key, {i, j, k}));
        if (cube != urban_nav_registration::CellTable::kNone) take(cube);
      }
}

}  // namespace scene_labeler
