// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/cloud/surfels.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <map>

#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::PointCloud;
using urban_nav_core::testing::Dice;

constexpr float kVoxel = 0.25F;
using Key = std::array<int, 3>;

Key keyAt(const Eigen::Vector3f& point) {
  const Cell cell = toCell(point, 1.0F / kVoxel);
  return {cell.x, cell.y, cell.z};
}

/// Hilly ground on both sides of the origin, with points dense enough for cubes of one voxel.
PointCloud hills() {
  Dice dice(5);
  PointCloud cloud;
  for (int i = 0; i < 40000; ++i) {
    const double x = dice.uniform(-6.0, 6.0), y = dice.uniform(-6.0, 6.0);
    cloud.points.push_back(
        Eigen::Vector3d(x, y, std::sin(0.7 * x) * std::cos(0.5 * y) + 0.02 * dice.uniform(-1.0, 1.0)).cast<float>());
  }
  return cloud;
}

TEST(Surfels, NormalsAreThoseOfThe27CubesEachOfEqualWeight) {
  const PointCloud cloud = hills();
  std::map<Key, std::vector<Eigen::Vector3d>> cubes;
  for (const auto& point : cloud.points) cubes[keyAt(point)].push_back(point.cast<double>());
  const Surfels surfels = makeSurfels(cloud, kVoxel);
  ASSERT_EQ(surfels.all.size(), cubes.size());
  std::size_t compared = 0;
  for (const Surfel& surfel : surfels.all) {
    const Key own = keyAt(surfel.mean);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();
    double count = 0.0;
    for (const auto& [key, points] : cubes) {
      if (std::abs(key[0] - own[0]) > 1 || std::abs(key[1] - own[1]) > 1 || std::abs(key[2] - own[2]) > 1) continue;
      for (const Eigen::Vector3d& point : points) {
        const double share = 1.0 / static_cast<double>(points.size());
        sum += share * point;
        outer += share * point * point.transpose();
      }
      count += 1.0;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(outer / count - sum * sum.transpose() / count / count);
    const Eigen::Vector3d variance = eigen.eigenvalues();
    if (count < 3.0 || variance[1] < 0.05 * 0.0625) continue;  // normals of these come from larger cubes
    EXPECT_GT(std::abs(surfel.normal.cast<double>().dot(eigen.eigenvectors().col(0))), 0.9999);
    EXPECT_NEAR(static_cast<double>(surfel.planarity), 1.0 - variance[0] / variance[1], 1e-3);
    EXPECT_LE(surfel.normal.dot(surfel.mean), 0.0F);
    ++compared;
  }
  EXPECT_GT(compared, surfels.all.size() * 9 / 10);
}

TEST(Surfels, SparseBeamsHaveNormalsFromLargerCubes) {
  PointCloud cloud;  // a wall at x = 20 m, beams 0.9 m apart
  for (int y = -9; y <= 9; ++y)
    for (int z = -3; z <= 9; ++z)
      cloud.points.emplace_back(20.1F, 0.9F * static_cast<float>(y), 0.9F * static_cast<float>(z));
  for (const Surfel& surfel : makeSurfels(cloud, kVoxel).all) {
    EXPECT_GT(surfel.planarity, 0.99F);
    EXPECT_LT(surfel.normal.x(), -0.999F);
  }
}

TEST(Surfels, TheKeyOfANeighbouringCellIsFoundWithoutTheCell) {
  for (const Cell& cell : {Cell{0, 0, 0}, Cell{-1, 5, -7}, Cell{kFarthestCell, -kFarthestCell, kFarthestCell}})
    for (const Cell& by : {Cell{-1, -1, -1}, Cell{1, -1, 0}, Cell{0, 1, 1}})
      EXPECT_EQ(keyBeside(toKey(cell), by), toKey({cell.x + by.x, cell.y + by.y, cell.z + by.z}));
}

}  // namespace
}  // namespace urban_nav_registration
