// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "scene_labeler/labelling/labeler.hpp"
#include "support/yard.hpp"

namespace scene_labeler::testing {

/// Yard in an image along x: grey ground below the horizon, an orange wall with bushes above it.
inline Yard makePicturedYard(unsigned seed) {
  Yard yard = makeYard(seed);
  yard.scene.view.image = cv::Mat(240, 320, CV_8UC3, cv::Scalar(30, 90, 180));
  yard.scene.view.image.rowRange(130, 240).setTo(cv::Scalar(120, 120, 120));
  Eigen::Matrix<double, 3, 4> projection;  // from (-1, 4, 1.2)
  projection << 160, -150, 0, 760, 120, 0, -150, 300, 1, 0, 0, 1;
  projectScene(projection, yard.scene);
  return yard;
}

inline std::uint8_t columnOf(const std::string& name) {
  const std::vector<std::string>& names = featureNames(FeatureSet::All);
  return static_cast<std::uint8_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Model of paving and walls: by height, and by colour if there is an image: paving is grey, walls are red.
inline LabelModel makePictureModel(const FeatureTable& table) {
  LabelModel model;
  model.classes = {SceneClass::Paved, SceneClass::Wall};
  model.bins = FeatureBins(table.values, table.columns());
  model.calibration.bias = model.patch_calibration.bias = {0.0F, 0.0F};
  const std::uint8_t height = columnOf("over_ground"), red = columnOf("red_7");
  model.trees.base = {0.0F, 0.0F};
  model.trees.trees.push_back({{{height, model.bins.code(height, 0.1F), false, -1, -2}}, {2.0F, 0.0F, 0.0F, 2.0F}});
  model.trees.trees.push_back({{{red, 0, false, -1, 1}, {red, model.bins.code(red, 0.45F), false, -2, -3}},
                               {0.0F, 0.0F, 2.0F, 0.0F, 0.0F, 2.0F}});
  return model;
}

}  // namespace scene_labeler::testing
