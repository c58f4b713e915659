// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/parameters.hpp"

#include <gtest/gtest.h>

#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/parameter_tables.hpp"

namespace dense_stereo {
namespace {

TEST(Parameters, YamlAndReadmeEqualTheTable) {
  EXPECT_EQ(urban_nav_core::testing::findFaults(table().stage(), table().rows(), nodeletTable().rows()), "");
}

TEST(Parameters, TheYamlFileGivesTheDefaults) {
  const auto loaded = load(table(), urban_nav_core::readParameters("config/dense_stereo.yaml"));
  const Parameters defaults;
  for (const auto& row : table().rows())
    EXPECT_EQ(printValue(table().get(loaded.parameters, row.name)), printValue(table().get(defaults, row.name)))
        << row.name;
}

}  // namespace
}  // namespace dense_stereo
