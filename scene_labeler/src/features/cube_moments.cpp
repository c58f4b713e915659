// SPDX-License-Identifier: BSD-3-Clause
#include "features/cube_moments.hpp"

namespace scene_labeler {

using urban_nav_registration::Cell;
using urban_nav_registration::CellTable;

void Moments::add(const Eigen::Vector3d& point, double weight) {
  sum += weight * point;
  outer += weight * point * point.transpose();
  count += weight;
}

void Moments::add(const Moments& other) {
  sum += other.sum;
  outer += other.outer;
  count += other.count;
}

Eigen::Matrix3d Moments::covariance() const {
  const Eigen::Vector3d centre = mean();
  return outer / count - centre * centre.transpose();
}

namespace {

std::uint32_t insertCube(CubeLevel& level, const Cell& cell) {
  const std::uint64_t key = urban_nav_registration::toKey(cell);
  const std::uint32_t cube = level.table.insert(key);
  if (cube == level.cubes.size()) {
    level.cubes.emplace_back();
    level.keys.push_back(key);
  }
  return cube;
}

Cell cellOfKey(std::uint64_t key) {
  const auto part = [key](unsigned shift) { return static_cast<int>(key >> shift & 0x1fffffU) - (1 << 20); };
  return {part(0), part(21), part(42)};
}

/// Gives each cube the weight of one point, and its mean reflectance.
void normalise(CubeLevel& level) {
  for (std::size_t i = 0; i < level.cubes.size(); ++i) {
    Moments& cube = level.cubes[i];
    if (!level.reflectance.empty()) level.reflectance[i] /= static_cast<float>(cube.count);
    cube.sum /= cube.count;
    cube.outer /= cube.count;
    cube.count = 1.0;
  }
}

CubeLevel finestLevel(const std::vector<Eigen::Vector3f>& points, const std::vector<float>& reflectance,
                      const Eigen::Vector3f& origin) {
  CubeLevel level;
  level.edge = finest_cube;
  level.table = CellTable(points.size() / 8 + 16);
  level.cube_of.assign(points.size(), CellTable::none);
  const float per_m = 1.0F / finest_cube,
              limit = finest_cube * static_cast<float>(urban_nav_registration::kFarthestCell);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f point = points[i] - origin;
    if (!point.allFinite() || !(point.cwiseAbs().maxCoeff() < limit)) continue;
    const std::uint32_t cube = insertCube(level, urban_nav_registration::toCell(point, per_m));
    level.cube_of[i] = cube;
    level.cubes[cube].add(point.cast<double>(), 1.0);
    if (!reflectance.empty()) {
      level.reflectance.resize(level.cubes.size());
      level.reflectance[cube] += reflectance[i];
    }
  }
  normalise(level);
  return level;
}

CubeLevel coarserLevel(const CubeLevel& finer) {
  CubeLevel level;
  level.edge = 2.0F * finer.edge;
  level.table = CellTable(finer.cubes.size() / 2 + 16);
  std::vector<std::uint32_t> coarse_of(finer.cubes.size());
  for (std::size_t i = 0; i < finer.cubes.size(); ++i) {
    const Cell cell = cellOfKey(finer.keys[i]);
    coarse_of[i] = insertCube(level, {cell.x >> 1, cell.y >> 1, cell.z >> 1});
    level.cubes[coarse_of[i]].add(finer.cubes[i]);
    if (!finer.reflectance.empty()) {
      level.reflectance.resize(level.cubes.size());
      level.reflectance[coarse_of[i]] += finer.reflectance[i];
    }
  }
  level.cube_of.reserve(finer.cube_of.size());
  for (const std::uint32_t cube : finer.cube_of)
    level.cube_of.push_back(cube == CellTable::none ? CellTable::none : coarse_of[cube]);
  normalise(level);
  return level;
}

}  // namespace

std::array<CubeLevel, shape_levels> makeCubeLevels(const std::vector<Eigen::Vector3f>& points,
                                                   const std::vector<float>& reflectance,
                                                   const Eigen::Vector3f& origin) {
  std::array<CubeLevel, shape_levels> levels;
  levels[0] = finestLevel(points, reflectance, origin);
  for (std::size_t i = 1; i < levels.size(); ++i) levels[i] = coarserLevel(levels[i - 1]);
  return levels;
}

}  // namespace scene_labeler
