// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/features/features.hpp"

#include <algorithm>
#include <cmath>

#include "features/cloud_features.hpp"
#include "features/look_features.hpp"
#include "features/shape_features.hpp"

namespace scene_labeler {
namespace {

struct NamedFeatures {
  std::vector<std::string> names;
  std::size_t first_of_image = 0;
};

NamedFeatures namedFeatures(std::vector<std::string> shape, const std::vector<std::string>& look) {
  NamedFeatures named{std::move(shape), 0};
  named.first_of_image = named.names.size();
  named.names.insert(named.names.end(), look.begin(), look.end());
  return named;
}

const NamedFeatures& namedSet(FeatureSet set) {
  static const NamedFeatures paper = namedFeatures(paperShapeNames(), paperLookNames());
  static const NamedFeatures all = namedFeatures(shapeFeatureNames(), lookFeatureNames());
  static const NamedFeatures cloud = namedFeatures(cloudFeatureNames(), {});
  if (set == FeatureSet::Cloud) return cloud;
  return set == FeatureSet::Paper ? paper : all;
}

}  // namespace

const char* toString(FeatureSet set) {
  if (set == FeatureSet::Cloud) return "cloud";
  return set == FeatureSet::Paper ? "paper" : "all";
}

const std::vector<std::string>& featureNames(FeatureSet set) { return namedSet(set).names; }

std::size_t firstImageFeature(FeatureSet set) { return namedSet(set).first_of_image; }

void measureImageFeatures(const Scene& scene, FeatureSet set, FeatureTable& table) {
  if (set == FeatureSet::Cloud) return;
  const std::size_t first = firstImageFeature(set);
  for (std::size_t i = 0; i < table.rows(); ++i)
    std::fill(table.row(i) + first, table.row(i) + table.columns(), kMissingFeature);
  if (set == FeatureSet::Paper) measurePaperLook(scene, first, table);
  else measureLook(scene, first, table);
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (float* value = table.row(i) + first; value != table.row(i) + table.columns(); ++value)
      if (!std::isfinite(*value)) *value = kMissingFeature;
}

FeatureTable measureFeatures(const Scene& scene, FeatureSet set, bool with_reflectance) {
  FeatureTable table;
  table.names = featureNames(set);
  table.values.assign(table.names.size() * scene.points.size(), kMissingFeature);
  if (set == FeatureSet::Cloud) measureCloudShape(scene, table);
  else if (set == FeatureSet::Paper) measurePaperShape(scene, 0, table);
  else measureShape(scene, with_reflectance, 0, table);
  for (float& value : table.values)
    if (!std::isfinite(value)) value = kMissingFeature;
  measureImageFeatures(scene, set, table);
  return table;
}

}  // namespace scene_labeler
