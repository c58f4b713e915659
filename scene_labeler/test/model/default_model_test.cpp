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

}  // namespace
}  // namespace scene_labeler
