// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/class_map.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"

namespace scene_labeler {
namespace {

using Classes = std::vector<SceneClass>;

TEST(ClassMaps, OfSemanticKittiIgnoreTheInstance) {
  const ClassMap map("semantickitti");
  const std::int64_t instance = std::int64_t{713} << 16;
  EXPECT_EQ(map.toClasses({10, instance + 10, instance + 252, 40, 48, 50, 70, 72, 30, 0}, "p"),
            (Classes{SceneClass::Vehicle, SceneClass::Vehicle, SceneClass::Vehicle, SceneClass::Paved,
                     SceneClass::Paved, SceneClass::Wall, SceneClass::Foliage, SceneClass::Grass, SceneClass::Other,
                     SceneClass::None}));
}

TEST(ClassMaps, OfNuScenesHaveTheNumbersOfTheReleasedFiles) {
  const ClassMap map("nuscenes");
  EXPECT_EQ(map.toClasses({0, 17, 24, 25, 26, 27, 28, 30, 31}, "p"),
            (Classes{SceneClass::None, SceneClass::Vehicle, SceneClass::Paved, SceneClass::None, SceneClass::Paved,
                     SceneClass::Grass, SceneClass::Wall, SceneClass::Foliage, SceneClass::None}));
  for (std::int64_t id = 0; id < 32; ++id) EXPECT_TRUE(map.classOf(id).has_value()) << id;
  EXPECT_FALSE(map.classOf(32).has_value());
}

TEST(ClassMaps, OfKittiCoverCityscapesAndKitti360) {
  const ClassMap map("kitti");
  EXPECT_EQ(map.toClasses({-1, 7, 8, 11, 21, 22, 23, 26, 34}, "p"),
            (Classes{SceneClass::Vehicle, SceneClass::Paved, SceneClass::Paved, SceneClass::Wall, SceneClass::Foliage,
                     SceneClass::Grass, SceneClass::None, SceneClass::Vehicle, SceneClass::Wall}));
  for (std::int64_t id = -1; id <= 44; ++id) EXPECT_TRUE(map.classOf(id).has_value()) << id;
}

TEST(ClassMaps, NameTheDataSetOfAnUnknownLabel) {
  try {
    ClassMap("semantickitti").toClasses({40, 41}, "scan.csv");
    FAIL();
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_EQ(std::string(error.what()), "scan.csv: label = 41: expected the ids of SemanticKITTI");
  }
}

TEST(ClassMaps, ListTheKnownNamesForAnotherOne) {
  try {
    const ClassMap map("cityscape");
    FAIL();
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find("kitti, semantickitti, nuscenes"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scene_labeler
