// SPDX-License-Identifier: BSD-3-Clause
#include "features/growing_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "features/cloud_features.hpp"
#include "features/cube_shape.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace scene_labeler {

using urban_nav_registration::CellTable;

namespace {

// A surface crosses four cubes of 5 cm in one of 10 cm: the density of the scenes of training.
constexpr double kMostPointsOfCube = 4.0;
constexpr std::size_t kPaperLevel = 2;  // as measurePaperShape()
constexpr std::uint32_t kFewCubes = 1024;

float levelEdge(std::size_t level) { return kFinestCube * static_cast<float>(1U << level); }

/// Returns the place of a cube of the height level that determines its column: the mean of its points may move to
/// another column.
Eigen::Vector3f inMiddle(std::uint64_t key, float z) {
  const urban_nav_registration::Cell cell = cellOfKey(key);
  const float edge = levelEdge(kHeightLevel);
  return {edge * (static_cast<float>(cell.x) + 0.5F), edge * (static_cast<float>(cell.y) + 0.5F), z};
}

}  // namespace

void GrowingCloud::add(const std::vector<Eigen::Vector3f>& points) {
  for (const Eigen::Vector3f& point : points) addPoint(point);
}

void GrowingCloud::addPoint(const Eigen::Vector3f& point) {
  if (!point.allFinite()) return;
  if (!origin_) origin_ = point.array().round();
  const Eigen::Vector3f p = point - *origin_;
  constexpr float kFarthest = kFinestCube * static_cast<float>(urban_nav_registration::kFarthestCell);
  if (!(p.cwiseAbs().maxCoeff() < kFarthest)) return;
  const std::uint64_t key = urban_nav_registration::toKey(urban_nav_registration::toCell(p, 1.0F / kFinestCube));
  const std::uint32_t cube = levels_[0].table.find(key);
  if (cube != CellTable::kNone && sums_[0][cube].count >= kMostPointsOfCube) return;
  Moments one;
  one.add(p.cast<double>(), 1.0);
  update(0, key, one);
}

std::uint32_t GrowingCloud::findOrInsert(std::size_t level, std::uint64_t key) {
  CubeLevel& cubes = levels_[level];
  cubes.edge = levelEdge(level);
  const std::uint32_t cube = cubes.table.insert(key);
  if (cube < cubes.cubes.size()) return cube;
  cubes.cubes.emplace_back();
  cubes.keys.push_back(key);
  sums_[level].emplace_back();
  return cube;
}

void GrowingCloud::update(std::size_t level, std::uint64_t key, const Moments& change) {
  const std::uint32_t cube = findOrInsert(level, key);
  sums_[level][cube].add(change);
  Moments coarse_change = sums_[level][cube].normalised();
  coarse_change.subtract(levels_[level].cubes[cube]);
  levels_[level].cubes[cube] = sums_[level][cube].normalised();
  if (level == kHeightLevel) {
    const auto z = static_cast<float>(levels_[level].cubes[cube].mean().z());
    if (cube == column_of_.size()) column_of_.push_back(columns_.add(inMiddle(key, z)));
    else columns_.extend(column_of_[cube], z);
  }
  if (level + 1 < kCubeLevels) update(level + 1, coarserKey(key), coarse_change);
}

void GrowingCloud::keepAround(const Eigen::Vector3f& place, float reach) {
  if (!origin_) return;
  GrowingCloud kept;
  kept.origin_ = origin_;
  const Eigen::Vector3d middle = (place - *origin_).cast<double>();
  const double square = static_cast<double>(reach) * static_cast<double>(reach);
  constexpr std::size_t kCoarsest = kCubeLevels - 1;
  for (std::size_t level = kCubeLevels; level-- > 0;) {
    const CubeLevel& cubes = levels_[level];
    kept.levels_[level].table = CellTable(cubes.cubes.size() / 2 + 16);
    for (std::size_t cube = 0; cube < cubes.cubes.size(); ++cube) {
      std::uint64_t key = cubes.keys[cube];
      for (std::size_t i = level; i < kCoarsest; ++i) key = coarserKey(key);
      const bool is_kept = level == kCoarsest ? (cubes.cubes[cube].mean() - middle).head<2>().squaredNorm() <= square
                                              : kept.levels_[kCoarsest].table.find(key) != CellTable::kNone;
      if (!is_kept) continue;
      const std::uint32_t number = kept.findOrInsert(level, cubes.keys[cube]);
      kept.levels_[level].cubes[number] = cubes.cubes[cube];
      kept.sums_[level][number] = sums_[level][cube];
      if (level == kHeightLevel)
        kept.column_of_.push_back(
            kept.columns_.add(inMiddle(cubes.keys[cube], static_cast<float>(cubes.cubes[cube].mean().z()))));
    }
  }
  *this = std::move(kept);
}

std::uint32_t GrowingCloud::findCube(std::size_t level, const Eigen::Vector3f& point) const {
  if (!origin_ || !point.allFinite()) return CellTable::kNone;
  const Eigen::Vector3f p = point - *origin_;
  if (!(p.cwiseAbs().maxCoeff() < kFinestCube * static_cast<float>(urban_nav_registration::kFarthestCell)))
    return CellTable::kNone;
  std::uint64_t key = urban_nav_registration::toKey(urban_nav_registration::toCell(p, 1.0F / kFinestCube));
  for (std::size_t i = 0; i < level; ++i) key = coarserKey(key);
  return levels_[level].table.find(key);
}

namespace {

GrowingCloud::Distinct distinctNumbers(const std::vector<std::uint32_t>& numbers, std::size_t count) {
  GrowingCloud::Distinct distinct;
  std::vector<std::uint32_t> index(count, CellTable::kNone);
  distinct.index_of.reserve(numbers.size());
  for (const std::uint32_t number : numbers) {
    if (number == CellTable::kNone) {
      distinct.index_of.push_back(CellTable::kNone);
      continue;
    }
    if (index[number] == CellTable::kNone) {
      index[number] = static_cast<std::uint32_t>(distinct.numbers.size());
      distinct.numbers.push_back(number);
    }
    distinct.index_of.push_back(index[number]);
  }
  return distinct;
}

}  // namespace

GrowingCloud::Distinct GrowingCloud::distinctCubes(std::size_t level,
                                                   const std::vector<Eigen::Vector3f>& points) const {
  std::vector<std::uint32_t> cubes;
  cubes.reserve(points.size());
  for (const Eigen::Vector3f& point : points) cubes.push_back(findCube(level, point));
  return distinctNumbers(cubes, levels_[level].cubes.size());
}

std::vector<CubeShape> GrowingCloud::measureShapes(std::size_t level, const std::vector<std::uint32_t>& cubes) const {
  std::vector<CubeShape> shapes(cubes.size());
  urban_nav_core::forEach(shapes.size(), kFewCubes,
                          [&](std::size_t i) { shapes[i] = shapeAround(levels_[level], cubes[i]); });
  return shapes;
}

void GrowingCloud::measureLevel(std::size_t level, const std::vector<Eigen::Vector3f>& points, FeatureSet set,
                                std::size_t first, FeatureTable& table) const {
  const Distinct distinct = distinctCubes(level, points);
  const std::vector<CubeShape> shapes = measureShapes(level, distinct.numbers);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (distinct.index_of[i] == CellTable::kNone) continue;
    const CubeShape& shape = shapes[distinct.index_of[i]];
    float* out = table.row(i) + first;
    if (set == FeatureSet::All) {
      writeShape(shape, points[i] - *origin_, levels_[level].edge, out);
    } else if (shape.is_known) {
      out[0] = shape.normal_z;
      out[1] = shape.planarity;
    }
  }
}

void GrowingCloud::measureCloud(const std::vector<Eigen::Vector3f>& points, FeatureTable& table) const {
  std::array<std::vector<CubeShape>, kCubeLevels> shapes;
  std::array<Distinct, kCubeLevels> cubes;
  for (std::size_t level = 0; level < kCubeLevels; ++level) {
    cubes[level] = distinctCubes(level, points);
    shapes[level] = measureShapes(level, cubes[level].numbers);
  }
  const std::vector<ColumnHeights> heights = measureHeights(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cubes[0].index_of[i] == CellTable::kNone) continue;
    ShapesOfPoint around;
    for (std::size_t level = 0; level < kCubeLevels; ++level) around[level] = &shapes[level][cubes[level].index_of[i]];
    writeCloudFeatures(around, heights[i], points[i] - *origin_, table.row(i));
  }
}

std::vector<ColumnHeights> GrowingCloud::measureHeights(const std::vector<Eigen::Vector3f>& points) const {
  const CubeLevel& level = levels_[kHeightLevel];
  std::vector<std::uint32_t> cubes, columns;
  for (const Eigen::Vector3f& point : points) {
    cubes.push_back(findCube(kHeightLevel, point));
    columns.push_back(cubes.back() == CellTable::kNone ? CellTable::kNone : column_of_[cubes.back()]);
  }
  const Distinct distinct = distinctNumbers(columns, columns_.size());
  std::vector<ColumnGrid::Surrounding> around(distinct.numbers.size());
  urban_nav_core::forEach(around.size(), kFewCubes,
                          [&](std::size_t i) { around[i] = columns_.measureSurrounding(distinct.numbers[i]); });
  std::vector<ColumnHeights> heights(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cubes[i] == CellTable::kNone) continue;
    const auto z = static_cast<float>(level.cubes[cubes[i]].mean().z());
    heights[i] = columns_.measureHeights(columns[i], around[distinct.index_of[i]], z, level.edge);
  }
  return heights;
}

void GrowingCloud::measureColumns(const std::vector<Eigen::Vector3f>& points, FeatureSet set, std::size_t first,
                                  FeatureTable& table) const {
  const std::vector<ColumnHeights> heights = measureHeights(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (findCube(kHeightLevel, points[i]) == CellTable::kNone) continue;
    if (set == FeatureSet::Paper) table.row(i)[first] = heights[i].over_ground;
    else writeHeights(heights[i], table.row(i) + first);
  }
}

FeatureTable GrowingCloud::measure(const std::vector<Eigen::Vector3f>& points, FeatureSet set) const {
  FeatureTable table;
  table.names = featureNames(set);
  table.values.assign(table.names.size() * points.size(), kMissingFeature);
  if (set == FeatureSet::Cloud) {
    measureCloud(points, table);
  } else if (set == FeatureSet::Paper) {
    measureColumns(points, set, 0, table);
    measureLevel(kPaperLevel, points, set, 1, table);
  } else {
    for (std::size_t level = 0; level < kShapeLevels; ++level)
      measureLevel(level, points, set, level * kShapeValues, table);
    measureColumns(points, set, kShapeLevels * kShapeValues, table);
  }
  for (float& value : table.values)
    if (!std::isfinite(value)) value = kMissingFeature;
  return table;
}

}  // namespace scene_labeler
