// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "scene_labeler/model/label_model.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {
namespace {

TEST(DefaultModel, HasTheSevenClassesOfThePaperAndIsSmall) {
  const LabelModel model = defaultModel();
  EXPECT_EQ(model.classes.size(), 8u);
  EXPECT_EQ(model.classes.front(), SceneClass::Other);
  EXPECT_EQ(model.classes.back(), SceneClass::Vehicle);
  EXPECT_EQ(model.device, kLms291Device);
  EXPECT_GE(model.sources.size(), 10u);
  EXPECT_LE(defaultModelBytes().size(), 1'000'000u);
  EXPECT_GE(model.samples.size(), 5000u) << "required for corrections";
}

TEST(DefaultModel, HasOneByShapeForCloudsOfOtherDevices) {
  const LabelModel model = defaultModel();
  ASSERT_NE(model.of_other_devices, nullptr);
  const LabelModel& clouds = modelFor(model, "");
  EXPECT_EQ(&clouds, model.of_other_devices.get());
  EXPECT_EQ(&modelFor(model, kLms291Device), &model);
  EXPECT_EQ(&modelFor(clouds, kLms291Device), &clouds) << "a model without another is for all devices";
  EXPECT_EQ(clouds.features, FeatureSet::Cloud);
  EXPECT_EQ(clouds.device, "") << "its thresholds are those of clouds of unknown devices";
  EXPECT_FALSE(clouds.sure.empty());
  EXPECT_LE(defaultCloudModelBytes().size(), 1'000'000u);
  EXPECT_GE(clouds.samples.size(), 5000u) << "required for corrections";
}

TEST(DefaultModel, HasThePrecisionForAllDevices) {
  const LabelModel model = withPrecision(defaultModel(), 0.9);
  EXPECT_EQ(model.precision, 0.9);
  EXPECT_EQ(modelFor(model, "").precision, 0.9);
  EXPECT_EQ(modelFor(defaultModel(), "").precision, kStandardPrecision) << "the built-in model is unchanged";
}

}  // namespace
}  // namespace scene_labeler
