// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/shared_settings.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/camera/camera_noise.hpp"

namespace urban_nav_core {
namespace {

struct SharedNoise {
  double disparity_offset;
  double pixel_noise_floor;
};

std::vector<Setting> collectSettings(const std::string& stage, const std::vector<Assignment>& assignments) {
  const Table<SharedNoise> table(stage, {disparityOffsetRow<SharedNoise>(), pixelNoiseFloorRow<SharedNoise>()});
  return load(table, assignments).settings;
}

TEST(SharedSettings, StagesWithDefaultsAgree) {
  const auto one = collectSettings("vo", {}), other = collectSettings("loops", {});
  EXPECT_TRUE(differingValues({&one, &other}, cameraNoiseNames()).empty());
  EXPECT_TRUE(differingValues({&one}, cameraNoiseNames()).empty());
  EXPECT_TRUE(differingValues({}, cameraNoiseNames()).empty());
}

TEST(SharedSettings, DifferentValuesAreNamedWithTheirOrigins) {
  const auto one = collectSettings("vo", {parseSetting("vo.disparity_offset=0.3")}),
             other = collectSettings("loops", {});
  const std::vector<std::string> sentences = differingValues({&one, &other}, cameraNoiseNames());
  ASSERT_EQ(sentences.size(), 1U);
  for (const char* part : {"vo.disparity_offset = 0.3", "--set", "loops.disparity_offset = 0.1", "default"})
    EXPECT_NE(sentences[0].find(part), std::string::npos) << sentences[0];
}

TEST(SharedSettings, EqualValuesInOtherFormsAgree) {
  const auto one = collectSettings("vo", {parseSetting("vo.disparity_offset=0.30")}),
             other = collectSettings("loops", {parseSetting("loops.disparity_offset=3e-1")});
  EXPECT_TRUE(differingValues({&one, &other}, cameraNoiseNames()).empty());
}

}  // namespace
}  // namespace urban_nav_core
