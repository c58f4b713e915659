// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/mounting_check.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/pictured_yard.hpp"

namespace scene_labeler {
namespace {

TEST(MountingCheck, FindsACameraThatIsUpsideDown) {
  testing::Yard yard = testing::makePicturedYard(9);
  const LabelModel model = testing::makePictureModel(measureFeatures(yard.scene, FeatureSet::All));
  MountingCheck upright(model), upside_down(model), without(model);
  upright.add(yard.scene, measureSceneFeatures(model, yard.scene));
  EXPECT_LT(upright.evidence(), 0.0);
  EXPECT_FALSE(upright.isUpsideDown());
  cv::rotate(yard.scene.view.image.clone(), yard.scene.view.image, cv::ROTATE_180);
  for (int frame = 0; frame < 3; ++frame) upside_down.add(yard.scene, measureSceneFeatures(model, yard.scene));
  EXPECT_GT(upside_down.evidence(), 0.0);
  EXPECT_TRUE(upside_down.isUpsideDown());
  EXPECT_NEAR(upside_down.evidence(), -upright.evidence(), 1e-6) << "the same comparison with the sides swapped";
  yard.scene.view = {};
  without.add(yard.scene, measureSceneFeatures(model, yard.scene));
  EXPECT_EQ(without.evidence(), 0.0);
  EXPECT_FALSE(without.isUpsideDown());
}

// Shape with inaccurate poses: lawn and path hardly differ in it.
TEST(MountingCheck, IsNotMisledWhereShapeTakesPavingForLawn) {
  const testing::Yard yard = testing::makePicturedYard(9);
  LabelModel model = testing::makePictureModel(measureFeatures(yard.scene, FeatureSet::All));
  model.classes = {SceneClass::Paved, SceneClass::Grass, SceneClass::Wall};
  model.calibration.bias = model.patch_calibration.bias = model.trees.base = {0.0F, 0.0F, 0.0F};
  model.trees.trees[0].leaves = {0.0F, 3.0F, 0.0F, 0.0F, 0.0F, 3.0F};                    // by height: lawn, wall
  model.trees.trees[1].leaves = {0.0F, 0.0F, 0.0F, 5.0F, 0.0F, 0.0F, 0.0F, 0.0F, 2.0F};  // grey is paving, red is wall
  MountingCheck check(model);
  for (int frame = 0; frame < 4; ++frame) {
    check.add(yard.scene, measureSceneFeatures(model, yard.scene));
    EXPECT_LT(check.evidence(), 0.0);
    EXPECT_FALSE(check.isUpsideDown());
  }
}

}  // namespace
}  // namespace scene_labeler
