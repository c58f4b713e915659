// SPDX-License-Identifier: BSD-3-Clause
#include "features/cloud_features.hpp"

#include <cmath>

#include "urban_nav_core/io/numbers.hpp"

namespace scene_labeler {
namespace {

constexpr float kLeastLocalShare = 5.5F / 27.0F;  // six cubes
constexpr std::array<std::size_t, 2> kFixedLevels = {1, 2};

float edgeOfLevel(std::size_t level) { return kFinestCube * static_cast<float>(1U << level); }

std::size_t localLevel(const ShapesOfPoint& shapes) {
  std::size_t level = 0;
  while (level + 1 < kCubeLevels && !(shapes[level]->is_known && shapes[level]->occupied > kLeastLocalShare)) ++level;
  return level;
}

}  // namespace

std::vector<std::string> cloudFeatureNames() {
  std::vector<std::string> names = {"over_ground",   "over_lowest_1", "over_lowest_3", "below_highest",
                                    "column_extent", "highest_1",     "raised_1",      "relative_roughness",
                                    "linearity",     "planarity",     "scatter",       "normal_z",
                                    "tangent_z",     "vertical",      "off_mean",      "spacing"};
  for (const std::size_t level : kFixedLevels)
    for (const char* value :
         {"linearity", "planarity", "scatter", "normal_z", "tangent_z", "roughness", "vertical", "off_mean"})
      names.push_back(std::string(value) + "_" + urban_nav_core::printNumber(edgeOfLevel(level)));
  names.emplace_back("off_plane");
  return names;
}

void writeCloudFeatures(const ShapesOfPoint& shapes, const ColumnHeights& heights, const Eigen::Vector3f& point,
                        float* out) {
  const SurroundingTops& tops = heights.tops;
  for (const float value : {heights.over_ground, heights.over_lowest_1, heights.over_lowest_3, heights.below_highest,
                            heights.column_extent, tops.highest_1, tops.raised_1})
    *out++ = value;
  const std::size_t level = localLevel(shapes);
  const CubeShape& local = *shapes[level];
  const float edge = edgeOfLevel(level);
  if (local.is_known) *out = local.roughness / edge;
  ++out;
  if (local.is_known) {
    out[0] = local.linearity;
    out[1] = local.planarity;
    out[2] = local.scatter;
    out[3] = local.normal_z;
    out[4] = local.tangent_z;
    out[5] = local.vertical;
  }
  out[6] = (point.z() - local.mean.z()) / edge;
  out[7] = static_cast<float>(level);
  out += 8;
  for (const std::size_t fixed : kFixedLevels) {
    const CubeShape& shape = *shapes[fixed];
    out[7] = (point.z() - shape.mean.z()) / edgeOfLevel(fixed);
    if (shape.is_known) {
      out[0] = shape.linearity;
      out[1] = shape.planarity;
      out[2] = shape.scatter;
      out[3] = shape.normal_z;
      out[4] = shape.tangent_z;
      out[5] = shape.roughness;
      out[6] = shape.vertical;
    }
    out += 8;
  }
  if (local.is_known) *out = std::abs(local.normal.dot(point - local.mean)) / edge;
}

}  // namespace scene_labeler
