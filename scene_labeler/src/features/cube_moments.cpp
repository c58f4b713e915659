// SPDX-License-Identifier: BSD-3-Clause
#include "features/cube_moments.hpp"

#include <cmath>
#include <limits>

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

void Moments::subtract(const Moments& other) {
  sum -= other.sum;
  outer -= other.outer;
  count -= other.count;
}

Eigen::Matrix3d Moments::covariance() const {
  const Eigen::Vector3d centre = mean();
  return outer / count - centre * centre.transpose();
}

Cell cellOfKey(std::uint64_t key) {
  const auto part = [key](unsigned shift) { return static_cast<int>(key >> shift & 0x1fffffU) - (1 << 20); };
  return {part(0), part(21), part(42)};
}

namespace {

std::uint32_t insertCube(CubeLevel& level, std::uint64_t key) {
  const std::uint32_t cube = level.table.insert(key);
  if (cube == level.cubes.size()) {
    level.cubes.emplace_back();
    level.keys.push_back(key);
  }
  return cube;
}

/// Normalises each cube to the weight of one point.
void normalise(CubeLevel& level) {
  for (Moments& cube : level.cubes) cube = cube.normalised();
}

CubeLevel finestLevel(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& origin) {
  CubeLevel level;
  level.edge = kFinestCube;
  level.table = CellTable(points.size() / 8 + 16);
  level.cube_of.assign(points.size(), CellTable::kNone);
  const float per_m = 1.0F / kFinestCube,
              limit = kFinestCube * static_cast<float>(urban_nav_registration::kFarthestCell);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f point = points[i] - origin;
    if (!point.allFinite() || !(point.cwiseAbs().maxCoeff() < limit)) continue;
    const std::uint32_t cube =
        insertCube(level, urban_nav_registration::toKey(urban_nav_registration::toCell(point, per_m)));
    level.cube_of[i] = cube;
    level.cubes[cube].add(point.cast<double>(), 1.0);
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
    coarse_of[i] = insertCube(level, coarserKey(finer.keys[i]));
    level.cubes[coarse_of[i]].add(finer.cubes[i]);
  }
  level.cube_of.reserve(finer.cube_of.size());
  for (const std::uint32_t cube : finer.cube_of)
    level.cube_of.push_back(cube == CellTable::kNone ? CellTable::kNone : coarse_of[cube]);
  normalise(level);
  return level;
}

}  // namespace

std::uint64_t coarserKey(std::uint64_t key) {
  const Cell cell = cellOfKey(key);
  return urban_nav_registration::toKey({cell.x >> 1, cell.y >> 1, cell.z >> 1});
}

CubeLevels makeCubeLevels(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& origin) {
  CubeLevels levels;
  levels[0] = finestLevel(points, origin);
  for (std::size_t i = 1; i < levels.size(); ++i) levels[i] = coarserLevel(levels[i - 1]);
  return levels;
}

std::vector<float> meanOverCubes(const CubeLevels& levels, std::size_t level, const std::vector<float>& values) {
  struct Mean {
    float sum = 0.0F, count = 0.0F;
    void add(float value) {
      sum += value;
      count += 1.0F;
    }
  };
  std::vector<Mean> means(levels[0].cubes.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (levels[0].cube_of[i] != CellTable::kNone && !std::isnan(values[i])) means[levels[0].cube_of[i]].add(values[i]);
  for (std::size_t next = 1; next <= level; ++next) {
    std::vector<std::uint32_t> parents(levels[next - 1].cubes.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      if (levels[next].cube_of[i] != CellTable::kNone) parents[levels[next - 1].cube_of[i]] = levels[next].cube_of[i];
    std::vector<Mean> coarser(levels[next].cubes.size());
    for (std::size_t cube = 0; cube < parents.size(); ++cube)
      if (means[cube].count > 0.0F) coarser[parents[cube]].add(means[cube].sum / means[cube].count);
    means = std::move(coarser);
  }
  std::vector<float> result;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const Mean& mean : means) result.push_back(mean.count > 0.0F ? mean.sum / mean.count : kNan);
  return result;
}

}  // namespace scene_labeler
