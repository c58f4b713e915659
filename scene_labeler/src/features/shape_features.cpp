// SPDX-License-Identifier: BSD-3-Clause
#include "features/shape_features.hpp"

#include <algorithm>
#include <cmath>

#include "features/cloud_features.hpp"
#include "features/cube_moments.hpp"
#include "features/cube_shape.hpp"
#include "features/ground_height.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/laser/reflectance.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

using urban_nav_registration::CellTable;

constexpr std::size_t kReflectanceLevel = 1;

std::vector<CubeShape> measureShapes(const CubeLevel& level) {
  std::vector<CubeShape> shapes(level.cubes.size());
  urban_nav_core::forEach(shapes.size(), 512, [&](std::size_t i) { shapes[i] = shapeAround(level, i); });
  return shapes;
}

void writeLevel(const CubeLevel& level, const std::vector<CubeShape>& shapes, const Scene& scene,
                const Eigen::Vector3f& origin, std::size_t first, FeatureTable& table) {
  urban_nav_core::forEach(scene.points.size(), 4096, [&](std::size_t i) {
    if (level.cube_of[i] == CellTable::kNone) return;
    writeShape(shapes[level.cube_of[i]], scene.points[i] - origin, level.edge, table.row(i) + first);
  });
}

void writeHeights(const CubeLevel& level, std::size_t first, FeatureTable& table) {
  const std::vector<ColumnHeights> heights = measureHeights(level);
  for (std::size_t i = 0; i < level.cube_of.size(); ++i) {
    if (level.cube_of[i] == CellTable::kNone) continue;
    writeHeights(heights[level.cube_of[i]], table.row(i) + first);
  }
}

/// Returns the reflectance normalised for range and incidence where the sensor's position is known.
std::vector<float> normalisedReflectance(const Scene& scene, const CubeLevel& level,
                                         const std::vector<CubeShape>& shapes) {
  if (scene.to_sensor.empty()) return scene.reflectance;
  std::vector<float> values(scene.reflectance.size());
  urban_nav_core::forEach(values.size(), 4096, [&](std::size_t i) {
    const float range = scene.to_sensor[i].norm();
    const std::uint32_t cube = level.cube_of[i];
    float cosine = 1.0F;
    if (cube != CellTable::kNone && shapes[cube].isPlane() && range > 0.0F)
      cosine = std::abs(shapes[cube].normal.dot(scene.to_sensor[i])) / range;
    values[i] = urban_nav_core::normaliseReflectance(scene.reflectance[i], range, cosine);
  });
  return values;
}

void writeReflectance(const CubeLevels& levels, const std::vector<float>& reflectance, std::size_t first,
                      FeatureTable& table) {
  if (reflectance.empty()) return;
  const CubeLevel& level = levels[kReflectanceLevel];
  const std::vector<float> of_cubes = meanOverCubes(levels, kReflectanceLevel, reflectance);
  std::vector<float> means(level.cubes.size()), deviations(level.cubes.size());
  urban_nav_core::forEach(level.cubes.size(), 512, [&](std::size_t cube) {
    float sum = 0.0F, square = 0.0F, count = 0.0F;
    forEachNeighbour(level, level.keys[cube], [&](std::uint32_t other) {
      if (std::isnan(of_cubes[other])) return;
      sum += of_cubes[other];
      square += of_cubes[other] * of_cubes[other];
      count += 1.0F;
    });
    means[cube] = sum / count;
    deviations[cube] = std::sqrt(std::max(0.0F, square / count - means[cube] * means[cube]));
  });
  for (std::size_t i = 0; i < reflectance.size(); ++i) {
    if (level.cube_of[i] == CellTable::kNone) continue;
    float* out = table.row(i) + first;
    out[0] = reflectance[i];
    out[1] = means[level.cube_of[i]];
    out[2] = deviations[level.cube_of[i]];
  }
}

/// Near the points, so that single precision suffices.
Eigen::Vector3f chooseOrigin(const std::vector<Eigen::Vector3f>& points) {
  for (const Eigen::Vector3f& point : points)
    if (point.allFinite()) return point.array().round();
  return Eigen::Vector3f::Zero();
}

}  // namespace

std::vector<std::string> shapeFeatureNames() {
  std::vector<std::string> names;
  float edge = kFinestCube;
  for (std::size_t level = 0; level < kShapeLevels; ++level, edge *= 2.0F)
    for (const char* value : {"linearity", "planarity", "scatter", "normal_z", "tangent_z", "roughness", "vertical",
                              "off_plane", "occupied", "off_mean"})
      names.push_back(std::string(value) + "_" + urban_nav_core::printNumber(edge));
  for (const char* value : {"over_ground", "over_lowest_1", "over_lowest_3", "below_highest", "column_extent",
                            "column_filled", "reflectance", "reflectance_mean", "reflectance_deviation"})
    names.emplace_back(value);
  return names;
}

void measureShape(const Scene& scene, bool with_reflectance, std::size_t first, FeatureTable& table) {
  const Eigen::Vector3f origin = chooseOrigin(scene.points);
  const CubeLevels levels = makeCubeLevels(scene.points, origin);
  std::vector<CubeShape> shapes;
  for (std::size_t i = 0; i < kShapeLevels; ++i, first += kShapeValues) {
    shapes = measureShapes(levels[i]);
    writeLevel(levels[i], shapes, scene, origin, first, table);
  }
  writeHeights(levels[kHeightLevel], first, table);
  if (with_reflectance)
    writeReflectance(levels, normalisedReflectance(scene, levels[kShapeLevels - 1], shapes), first + kHeightValues,
                     table);
}

std::vector<Eigen::Vector3f> measureNormals(const std::vector<Eigen::Vector3f>& points) {
  const CubeLevels levels = makeCubeLevels(points, chooseOrigin(points));
  const CubeLevel& level = levels[kShapeLevels - 1];
  const std::vector<CubeShape> shapes = measureShapes(level);
  std::vector<Eigen::Vector3f> normals(points.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const std::uint32_t cube = level.cube_of[i]; cube != CellTable::kNone && shapes[cube].isPlane())
      normals[i] = shapes[cube].normal;
  return normals;
}

void measureCloudShape(const Scene& scene, FeatureTable& table) {
  const Eigen::Vector3f origin = chooseOrigin(scene.points);
  const CubeLevels levels = makeCubeLevels(scene.points, origin);
  std::array<std::vector<CubeShape>, kCubeLevels> shapes;
  for (std::size_t i = 0; i < kCubeLevels; ++i) shapes[i] = measureShapes(levels[i]);
  const std::vector<ColumnHeights> heights = measureHeights(levels[kHeightLevel]);
  urban_nav_core::forEach(scene.points.size(), 4096, [&](std::size_t i) {
    if (levels[0].cube_of[i] == CellTable::kNone) return;
    ShapesOfPoint around;
    for (std::size_t level = 0; level < kCubeLevels; ++level) around[level] = &shapes[level][levels[level].cube_of[i]];
    writeCloudFeatures(around, heights[levels[kHeightLevel].cube_of[i]], scene.points[i] - origin, table.row(i));
  });
}

std::vector<std::string> paperShapeNames() { return {"over_ground", "normal_z", "planarity"}; }

void measurePaperShape(const Scene& scene, std::size_t first, FeatureTable& table) {
  const auto levels = makeCubeLevels(scene.points, chooseOrigin(scene.points));
  const std::vector<ColumnHeights> heights = measureHeights(levels[kHeightLevel]);
  const CubeLevel& level = levels[kPaperLevel];
  const std::vector<CubeShape> shapes = measureShapes(level);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    if (level.cube_of[i] == CellTable::kNone) continue;
    float* out = table.row(i) + first;
    out[0] = heights[levels[kHeightLevel].cube_of[i]].over_ground;
    const CubeShape& shape = shapes[level.cube_of[i]];
    if (!shape.is_known) continue;
    out[1] = shape.normal_z;
    out[2] = shape.planarity;
  }
}

}  // namespace scene_labeler
