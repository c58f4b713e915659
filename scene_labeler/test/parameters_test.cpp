// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/parameters.hpp"

#include <gtest/gtest.h>

#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/parameter_tables.hpp"

namespace scene_labeler {
namespace {

TEST(Parameters, YamlAndReadmeEqualTheTable) {
  EXPECT_EQ(urban_nav_core::testing::findFaults(table().stage(), table().rows(), nodeletTable().rows()), "");
}

TEST(Parameters, TheYamlFileGivesTheDefaults) {
  const auto loaded = load(table(), urban_nav_core::readParameters("config/scene_labeler.yaml"));
  EXPECT_EQ(loaded.parameters.superpixel, Parameters().superpixel);
}

}  // namespace
}  // namespace scene_labeler
