// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/features/features.hpp"

#include <cmath>

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
  return set == FeatureSet::Paper ? paper : all;
}

}  // namespace

const char* toString(FeatureSet set) { return set == FeatureSet::Paper ? "paper" : "all"; }

const std::vector<std::string>& featureNames(FeatureSet set) { return namedSet(set).names; }

std::size_t firstImageFeature(FeatureSet set) { return namedSet(set).first_of_image; }

FeatureTable measureFeatures(const Scene& scene, FeatureSet set, bool with_reflectance) {
  FeatureTable table;
  table.names = featureNames(set);
  table.values.assign(table.names.size() * scene.points.size(), missing_feature);
  const std::size_t look = firstImageFeature(set);
  if (set == FeatureSet::Paper) {
    measurePaperShape(scene, 0, table);
    measurePaperLook(scene, look, table);
  } else {
    measureShape(scene, with_reflectance, 0, table);
    measureLook(scene, look, table);
  }
  for (float& value : table.values)
    if (!std::isfinite(value)) value = missing_feature;
  return table;
}

}  // namespace scene_labeler
