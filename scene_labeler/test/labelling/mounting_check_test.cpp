// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/mounting_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene_labeler/labelling/labeler.hpp"
#include "support/yard.hpp"

namespace scene_labeler {
namespace {

/// A yard in an image that looks along x: grey ground below the horizon, an orange wall with bushes above it.
testing::Yard makePicturedYard(unsigned seed) {
  testing::Yard yard = testing::makeYard(seed);
  yard.scene.view.image = cv::Mat(240, 320, CV_8UC3, cv::Scalar(30, 90, 180));
  yard.scene.view.image.rowRange(130, 240).setTo(cv::Scalar(120, 120, 120));
  Eigen::Matrix<double, 3, 4> projection;  // from (-1, 4, 1.2)
  projection << 160, -150, 0, 760, 120, 0, -150, 300, 1, 0, 0, 1;
  projectScene(projection, yard.scene);
  return yard;
}

std::uint8_t columnOf(const std::string& name) {
  const std::vector<std::string>& names = featureNames(FeatureSet::All);
  return static_cast<std::uint8_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Knows paving and walls: by height, and by colour where there is an image: paving is grey, walls are red.
LabelModel makeModel(const FeatureTable& table) {
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

TEST(MountingCheck, FindsACameraThatIsUpsideDown) {
  testing::Yard yard = makePicturedYard(9);
  const LabelModel model = makeModel(measureFeatures(yard.scene, FeatureSet::All));
  MountingCheck upright(model), upside_down(model), without(model);
  upright.add(yard.scene, measureSceneFeatures(model, yard.scene));
  EXPECT_LT(upright.evidence(), 0.0);
  EXPECT_FALSE(upright.isUpsideDown());
  cv::rotate(yard.scene.view.image.clone(), yard.scene.view.image, cv::ROTATE_180);
  for (int frame = 0; frame < 3; ++frame) upside_down.add(yard.scene, measureSceneFeatures(model, yard.scene));
  EXPECT_GT(upside_down.evidence(), 0.0);
  EXPECT_TRUE(upside_down.isUpsideDown());
  EXPECT_NEAR(upside_down.evidence(), -upright.evidence(), 1e-6) << "the same comparison, the other way round";
  yard.scene.view = {};
  without.add(yard.scene, measureSceneFeatures(model, yard.scene));
  EXPECT_EQ(without.evidence(), 0.0);
  EXPECT_FALSE(without.isUpsideDown());
}

}  // namespace
}  // namespace scene_labeler
