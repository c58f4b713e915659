// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/surfels.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "cloud/cell_table.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::PointCloud;

/// Sums over the points of a cube, measured from its lower corner so that single precision is enough.
struct Moments {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, count = 0;
  Cell cell;
};

Eigen::Vector3f cornerOf(const Cell& cell) {
  return {static_cast<float>(cell.x), static_cast<float>(cell.y), static_cast<float>(cell.z)};
}

/// Measured from a corner that lies by d further down.
inline void shiftBy(Moments& cube, const Eigen::Vector3f& d) {
  const Eigen::Vector3f nd = cube.count * d, s = cube.sum;
  cube.xx += (2.0F * s.x() + nd.x()) * d.x();
  cube.yy += (2.0F * s.y() + nd.y()) * d.y();
  cube.zz += (2.0F * s.z() + nd.z()) * d.z();
  cube.xy += s.x() * d.y() + s.y() * d.x() + nd.x() * d.y();
  cube.xz += s.x() * d.z() + s.z() * d.x() + nd.x() * d.z();
  cube.yz += s.y() * d.z() + s.z() * d.y() + nd.y() * d.z();
  cube.sum += nd;
}

inline void addTo(Moments& sum, const Moments& cube) {
  sum.sum += cube.sum;
  sum.xx += cube.xx;
  sum.xy += cube.xy;
  sum.xz += cube.xz;
  sum.yy += cube.yy;
  sum.yz += cube.yz;
  sum.zz += cube.zz;
  sum.count += cube.count;
}

constexpr float kLeastExtent = 0.04F;  // variance, in edges squared: a deviation of a fifth of the edge

bool isWithin(const Eigen::Vector3f& point, float limit) {
  return std::abs(point.x()) < limit && std::abs(point.y()) < limit && std::abs(point.z()) < limit;  // false for NaN
}

struct Grid {
  CellTable table;
  std::vector<Moments> cubes;
  std::size_t used = 0;
};

Grid gridOf(const PointCloud& cloud, float voxel) {
  Grid grid{CellTable(cloud.points.size() / 32 + 16), {}, 0};  // small: neighbours are looked up 27 at a time
  grid.cubes.reserve(cloud.points.size() / 8 + 16);
  const float per_m = 1.0F / voxel, limit = voxel * static_cast<float>(kFarthestCell);
  for (const Eigen::Vector3f& point : cloud.points) {
    if (!isWithin(point, limit)) continue;
    ++grid.used;
    const Cell cell = cellOf(point, per_m);
    const std::uint32_t number = grid.table.insert(keyOf(cell));
    if (number == grid.cubes.size()) {
      grid.cubes.emplace_back();
      grid.cubes.back().cell = cell;
    }
    Moments& cube = grid.cubes[number];
    const Eigen::Vector3f d = point - voxel * cornerOf(cell);
    cube.sum += d;
    cube.xx += d.x() * d.x();
    cube.xy += d.x() * d.y();
    cube.xz += d.x() * d.z();
    cube.yy += d.y() * d.y();
    cube.yz += d.y() * d.z();
    cube.zz += d.z() * d.z();
    cube.count += 1.0F;
  }
  // From sums to means: each cube weighs the same in its neighbours' normals, however many beams fell into it.
  for (Moments& cube : grid.cubes) {
    const float share = 1.0F / cube.count;
    cube.sum *= share;
    for (float* moment : {&cube.xx, &cube.xy, &cube.xz, &cube.yy, &cube.yz, &cube.zz}) *moment *= share;
    cube.count = 1.0F;
  }
  return grid;
}

/// The same points in cubes of twice the edge: each of the eight within counts as much as it has beams' cubes in it.
Grid coarser(const Grid& fine, float voxel) {
  Grid grid{CellTable(fine.cubes.size() / 4 + 16), {}, fine.used};
  grid.cubes.reserve(fine.cubes.size() / 2 + 16);
  for (const Moments& cube : fine.cubes) {
    const Cell cell{cube.cell.x >> 1, cube.cell.y >> 1, cube.cell.z >> 1};
    const std::uint32_t number = grid.table.insert(keyOf(cell));
    if (number == grid.cubes.size()) {
      grid.cubes.emplace_back();
      grid.cubes.back().cell = cell;
    }
    Moments shifted = cube;
    const Eigen::Vector3f d =
        voxel * Eigen::Vector3f(static_cast<float>(cube.cell.x & 1), static_cast<float>(cube.cell.y & 1),
                                static_cast<float>(cube.cell.z & 1));
    shiftBy(shifted, d);
    addTo(grid.cubes[number], shifted);
  }
  return grid;
}

/// Covariance of the points of a cube and its 26 neighbours.
struct Pooled {
  Eigen::Matrix3f covariance;
  float cubes = 0.0F;
};

Pooled pool(const Grid& grid, const Cell& middle, float voxel) {
  Moments all;
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const std::uint32_t number = grid.table.find(keyOf({middle.x + i, middle.y + j, middle.z + k}));
        if (number == CellTable::none) continue;
        Moments cube = grid.cubes[number];
        shiftBy(cube, voxel * Eigen::Vector3f(static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)));
        addTo(all, cube);
      }
  const float share = 1.0F / all.count;
  const Eigen::Vector3f mean = share * all.sum;
  Pooled pooled;
  pooled.covariance << all.xx, all.xy, all.xz, all.xy, all.yy, all.yz, all.xz, all.yz, all.zz;
  pooled.covariance = share * pooled.covariance - mean * mean.transpose();
  pooled.cubes = all.count;
  return pooled;
}

constexpr int kScales = 4;  // cubes of 1, 2, 4, 8 voxels: far from the sensor its beams are metres apart

/// All that surfels are made of.
struct Scales {
  std::vector<Grid> grids;  // from fine to coarse
  Eigen::Matrix3f flat;     // added to covariances: what a scan of one plane does not see of its walls
};

Surfel surfelOf(const Scales& scales, std::size_t number, float voxel) {
  const Moments& own = scales.grids[0].cubes[number];
  Surfel surfel;
  surfel.mean = voxel * cornerOf(own.cell) + own.sum / own.count;
  surfel.normal = Eigen::Vector3f::UnitZ();
  for (int scale = 0; scale < kScales; ++scale) {
    const float edge = voxel * static_cast<float>(1 << scale);
    const Pooled pooled = pool(scales.grids[static_cast<std::size_t>(scale)],
                               {own.cell.x >> scale, own.cell.y >> scale, own.cell.z >> scale}, edge);
    if (pooled.cubes < 3.0F) continue;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> eigen;
    eigen.computeDirect(pooled.covariance + edge * edge * scales.flat);
    const Eigen::Vector3f& variance = eigen.eigenvalues();
    // A surface reaches further than a part of its cube in both directions: one ring of a laser on the ground does not.
    if (!(variance[1] > kLeastExtent * edge * edge)) continue;
    surfel.normal = eigen.eigenvectors().col(0);
    if (surfel.normal.dot(surfel.mean) > 0.0F) surfel.normal = -surfel.normal;
    surfel.planarity = std::max(0.0F, 1.0F - std::max(variance[0], 0.0F) / variance[1]);
    return surfel;
  }
  return surfel;
}

/// n n^T of the plane in which all points lie, to a hundredth of the voxel, and the sensor with them; zero where they don't. A plane
/// that the sensor looks down upon is ground.
Eigen::Matrix3f flatnessOf(const Grid& grid, float voxel) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();
  for (const Moments& cube : grid.cubes) {
    const Eigen::Vector3d mean = (voxel * cornerOf(cube.cell) + cube.sum / cube.count).cast<double>();
    sum += mean;
    outer += mean * mean.transpose();
  }
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(grid.cubes.size(), 1));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(share * outer - share * share * sum * sum.transpose());
  const double square = static_cast<double>(voxel * voxel);
  if (!(eigen.eigenvalues()[0] < 1e-4 * square) || !(eigen.eigenvalues()[1] > square)) return Eigen::Matrix3f::Zero();
  if (std::abs(share * sum.dot(eigen.eigenvectors().col(0))) > 0.5 * static_cast<double>(voxel))
    return Eigen::Matrix3f::Zero();
  const Eigen::Vector3f normal = eigen.eigenvectors().col(0).cast<float>();
  return normal * normal.transpose();
}

}  // namespace

Surfels makeSurfels(const PointCloud& cloud, float voxel) {
  Scales scales;
  scales.grids.push_back(gridOf(cloud, voxel));
  for (int scale = 1; scale < kScales; ++scale)
    scales.grids.push_back(coarser(scales.grids.back(), voxel * static_cast<float>(1 << (scale - 1))));
  scales.flat = flatnessOf(scales.grids[0], voxel);
  Surfels surfels;
  surfels.voxel = voxel;
  surfels.points = scales.grids[0].used;
  surfels.left_out = cloud.points.size() - surfels.points;
  surfels.all.resize(scales.grids[0].cubes.size());
  urban_nav_core::forEach(surfels.all.size(), 512, [&](std::size_t i) { surfels.all[i] = surfelOf(scales, i, voxel); });
  return surfels;
}

}  // namespace loop_metric
